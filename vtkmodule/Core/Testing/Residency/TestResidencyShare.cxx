#include "pointfront/Residency/ResidencyShare.h"

#include <gtest/gtest.h>

#include <mutex>

using namespace pointfront;

namespace
{

/// Nodes of 10 points and any column; remembers what was asked for.
class RememberingReader final : public NodeReader
{
public:
  Result<NodeColumns> decode(const FetchedNode& fetched) const override
  {
    const NodeIndex node = fetched.node;
    const ColumnSelection& columns = fetched.columns;
    const std::lock_guard<std::mutex> lock(mutex_);
    asked_.push_back(node);
    NodeColumns result;
    result.node = node;
    result.positions.resize(10);
    result.selection = columns;
    result.columns.resize(columns.size(), std::vector<std::byte>(10));
    return result;
  }
  std::size_t decodedBytes(NodeIndex, std::uint32_t, const ColumnSelection& columns) const override
  {
    return sizeof(NodeColumns) + 120 + columns.size() * (10 + sizeof(std::vector<std::byte>));
  }
  std::size_t storedBytes(NodeIndex, const ColumnSelection&) const override { return 10; }
  std::vector<NodeIndex> asked() const
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    return asked_;
  }

private:
  mutable std::mutex mutex_;
  mutable std::vector<NodeIndex> asked_;
};

std::uint32_t needed(NodeIndex)
{
  return 0;
}

struct Shared
{
  std::shared_ptr<RememberingReader> reader = std::make_shared<RememberingReader>();
  ResidencyShare share{ reader, 100, ResidencyOptions{ 1 << 20, 1 } };
};

TEST(ResidencyShare, LoadsWhatAnyFrontWantsOnce)
{
  Shared s;
  const auto a = s.share.join();
  const auto b = s.share.join();
  EXPECT_EQ(s.share.wishes(), 2u);
  a->request({ { 1, 2.0 }, { 2, 1.0 } }, needed);
  b->request({ { 2, 9.0 }, { 3, 0.5 } }, needed);
  s.share.residency().waitUntilIdle();
  for (const NodeIndex node : { 1u, 2u, 3u })
  {
    EXPECT_EQ(s.share.residency().state(node), ResidencySnapshot::State::Resident);
  }
  EXPECT_EQ(s.reader->asked().size(), 3u);
}

TEST(ResidencyShare, ReadsTheColumnsOfAllFronts)
{
  Shared s;
  const auto a = s.share.join();
  auto b = s.share.join();
  a->setColumns({ 4 });
  b->setColumns({ 1, 4 });
  EXPECT_EQ(s.share.residency().columns(), (ColumnSelection{ 1, 4 }));
  b = nullptr;
  EXPECT_EQ(s.share.residency().columns(), (ColumnSelection{ 4 }));
}

TEST(ResidencyShare, KeepsWhatAnotherFrontNeeds)
{
  Shared s;
  const std::size_t one = s.reader->decodedBytes(0, 0, {});
  s.share.setBudgetBytes(2 * one + one / 2); // room for two nodes
  const auto a = s.share.join();
  const auto b = s.share.join();
  a->request({ { 1, 1.0 } }, [](NodeIndex node) { return node == 1 ? 0u : 3u; });
  b->request({ { 2, 1.0 } }, [](NodeIndex node) { return node == 2 ? 0u : 3u; });
  s.share.residency().waitUntilIdle();
  // A third node: both residents are needed by one of the two, so nothing gives way.
  a->request({ { 3, 1.0 } }, [](NodeIndex node) { return node == 1 || node == 3 ? 0u : 3u; });
  s.share.residency().waitUntilIdle();
  EXPECT_EQ(s.share.residency().state(1), ResidencySnapshot::State::Resident);
  EXPECT_EQ(s.share.residency().state(2), ResidencySnapshot::State::Resident);
  EXPECT_EQ(s.share.residency().state(3), ResidencySnapshot::State::Absent);
  // The second looks elsewhere: its node gives way.
  b->request({}, [](NodeIndex) { return 3u; });
  s.share.residency().waitUntilIdle();
  EXPECT_EQ(s.share.residency().state(2), ResidencySnapshot::State::Absent);
  EXPECT_EQ(s.share.residency().state(3), ResidencySnapshot::State::Resident);
}

} // namespace
