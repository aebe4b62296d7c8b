#include "CountedBytes.h"
#include "FilesInTheMaking.h"
#include "ForgedStore.h"
#include "SampleStore.h"
#include "StoreBuildTest.h"

#include "pointfront/Tiles/StoredCloudFormats.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <memory>
#include <string>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace pointfront
{
namespace
{
/// Where the nodes begin: a far store has its directory in memory.
std::vector<std::uint64_t> placesIn(const std::string& path)
{
  const auto line = CountedBytes::add();
  line->cost = { 0.05, 12.5e6, 8, std::size_t(1) << 20 };
  const auto store = PointStore::open(CountedBytes::addressOf(path));
  EXPECT_TRUE(store);
  std::vector<std::uint64_t> places;
  for (NodeIndex n = 0; n < (*store)->hierarchy()->nodeCount(); ++n)
  {
    EXPECT_TRUE((*store)->place(n)) << n;
    places.push_back((*store)->place(n).value_or(0));
  }
  return places;
}

TEST(LatePayloads, LieBehindAllOthersWithTheRootLast)
{
  const SampleStore sample = makeSample(200);
  const std::string path = temporaryPath("late.pfront");
  const auto writer = StoreWriter::create(path, sample.description.schema);
  ASSERT_TRUE(writer);
  std::vector<StoreWriter::PayloadId> payloads;
  const auto late = [&sample](std::size_t n) { return n % 3 == 0 || sample.nodes[n].level == 0; };
  for (std::size_t n = 0; n < sample.nodes.size(); ++n)
  {
    const EncodedNode node = encodeNode(sample.points[n], sample.description.schema);
    const auto id = late(n) ? (*writer)->appendLate(node) : (*writer)->append(node);
    ASSERT_TRUE(id) << id.error().what;
    payloads.push_back(*id);
  }
  const auto done = (*writer)->commit(sample.description, sample.nodes, sample.roots, payloads);
  ASSERT_TRUE(done) << done.error().what;
  EXPECT_EQ((*writer)->bytesWritten(), std::filesystem::file_size(path));
  const auto store = PointStore::open(path);
  ASSERT_TRUE(store);
  EXPECT_TRUE((*store)->verify()->ok);
  const std::vector<std::uint64_t> places = placesIn(path);
  for (NodeIndex n = 0; n < sample.nodes.size(); ++n)
  {
    const auto points = (*store)->read(n, everyColumn(sample.description.schema));
    ASSERT_TRUE(points) << points.error().what;
    EXPECT_EQ(points->positions, sample.points[n].positions);
    EXPECT_EQ(points->columns, sample.points[n].columns);
    for (NodeIndex before = 0; before < n; ++before)
    {
      const bool empty = sample.points[n].size() == 0 || sample.points[before].size() == 0;
      EXPECT_TRUE(empty || (places[n] > places[before]) == !late(before)) << before << ' ' << n;
    }
  }
}

/// Who opens a store from afar gets nothing beside its tables that pictures do not want.
TEST(LatePayloads, HaveTheirFirstPiecesBesideTheTables)
{
  const SampleStore sample = makeSample(5000);
  const std::string path = temporaryPath("late.pfront");
  const auto writer = StoreWriter::create(path, sample.description.schema);
  ASSERT_TRUE(writer);
  std::vector<StoreWriter::PayloadId> payloads;
  for (const NodeColumns& points : sample.points)
  {
    payloads.push_back(
      (*writer)->appendLate(encodeNode(points, sample.description.schema)).value());
  }
  ASSERT_TRUE((*writer)->commit(sample.description, sample.nodes, sample.roots, payloads));
  const auto store = PointStore::open(path);
  ASSERT_TRUE(store);
  ColumnSelection first;
  const ColumnPieces pieces = chooseColumnPieces(sample.description.schema);
  for (std::uint32_t c = 0; c < pieces.size(); ++c)
  {
    if (pieces[c] == 0)
    {
      first.push_back(c);
    }
  }
  ASSERT_GT(first.size(), 2u);
  std::uint64_t begin = payloadEndOf(ForgedStore(path).footer);
  const std::vector<std::uint64_t> places = placesIn(path);
  for (NodeIndex n = 0; n < places.size(); ++n)
  {
    begin -= (*store)->storedBytes(n, first);
    EXPECT_TRUE(sample.points[n].size() == 0 || places[n] == begin) << n;
  }
}

/// A store in the making that refers to another one gets what that one holds back.
TEST(LatePayloads, AreInAStoreThatRefersToTheWriter)
{
  const SampleStore sample = makeSample(200);
  const std::string path = temporaryPath("made.pfront");
  const auto writer = StoreWriter::create(path, sample.description.schema);
  ASSERT_TRUE(writer);
  std::vector<StoreWriter::PayloadId> payloads;
  for (std::size_t n = 0; n < sample.nodes.size(); ++n)
  {
    const EncodedNode node = encodeNode(sample.points[n], sample.description.schema);
    payloads.push_back(
      n < 4 ? (*writer)->appendLate(node).value() : (*writer)->append(node).value());
  }
  const std::string preview = temporaryPath("preview.pfront");
  auto written = (*writer)->written();
  ASSERT_TRUE(written);
  const auto referring =
    StoreWriter::createReferring(preview, sample.description.schema, std::move(*written));
  ASSERT_TRUE(referring);
  const auto done = (*referring)->commit(sample.description, sample.nodes, sample.roots, payloads);
  ASSERT_TRUE(done) << done.error().what;
  const auto shown = PointStore::open(preview);
  ASSERT_TRUE(shown) << shown.error().what;
  for (NodeIndex n = 0; n < sample.nodes.size(); ++n)
  {
    const auto points = (*shown)->read(n, everyColumn(sample.description.schema));
    ASSERT_TRUE(points) << points.error().what;
    EXPECT_EQ(points->positions, sample.points[n].positions);
    EXPECT_EQ(points->columns, sample.points[n].columns);
  }
  EXPECT_TRUE((*shown)->verify()->ok);
}

/// A limit on the size of files, which only the late payloads reach.
TEST(LatePayloads, AreToldOfWhereTheyDoNotFitAndLeaveNothing)
{
  const SampleStore sample = makeSample(50000);
  const std::string path = temporaryPath("a.pfront");
  const pid_t child = fork();
  ASSERT_GE(child, 0);
  if (child == 0)
  {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{ 100000, 100000 };
    setrlimit(RLIMIT_FSIZE, &limit);
    auto writer = StoreWriter::create(path, sample.description.schema);
    Result<StoreWriter::PayloadId> done = 0u;
    for (std::size_t node = 0; writer && done && node < sample.nodes.size(); ++node)
    {
      done = (*writer)->appendLate(encodeNode(sample.points[node], sample.description.schema));
    }
    writer = makeError(Error::Kind::Cancelled, "destroyed");
    const bool told = !done && done.error().kind == Error::Kind::Unwritable &&
      done.error().what.find("cannot write a temporary file in '") == 0;
    const std::filesystem::directory_iterator files(std::filesystem::path(path).parent_path());
    const bool left = std::any_of(begin(files), end(files),
      [](const auto& file) { return file.path().extension() == ".spill"; });
    _exit(told && !left && filesInTheMaking(path).empty() ? 0 : 1);
  }
  int status = 0;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
}

class LateNodes : public test::StoreBuildTest
{
protected:
  /// Builds a store and opens it from afar, as programs do.
  std::shared_ptr<const StoredCloud> builtFar(std::uint32_t nodePoints, std::size_t points)
  {
    options_.nodePoints = nodePoints;
    build(test::hills(points, 1e6));
    line_ = CountedBytes::add();
    line_->cost = { 0.05, 12.5e6, 8, std::size_t(1) << 20 };
    const auto far =
      StoredCloudFormats::ofProcess().open(CountedBytes::addressOf(options_.outputPath));
    EXPECT_TRUE(far) << far.error().what;
    return far ? *far : nullptr;
  }
  std::shared_ptr<CountedBytes> line_;
};
constexpr std::uint64_t lateFrom = 4 * 1000; // a 128th of the points is less than four leaves

/// The root and its children come with the tables of a store that has far more bytes.
TEST_F(LateNodes, OfABuiltStoreComeWithTheAnswerThatOpensIt)
{
  const auto far = builtFar(1000, 400000);
  ASSERT_TRUE(far);
  const Node root = far->hierarchy()->node(0);
  ASSERT_GT(root.childCount, 1);
  for (NodeIndex n = 0; n < root.firstChild + root.childCount; ++n)
  {
    ASSERT_TRUE(far->read(n, {}));
  }
  EXPECT_EQ(line_->rounds(), 1u);
  EXPECT_LT(line_->bytes, std::filesystem::file_size(options_.outputPath) / 2);
}

/// The tables alone are larger than what comes when it is opened, as those of 10^9 points are: the
/// root comes with the second answer.
TEST_F(LateNodes, OfAStoreWithLargeTablesComeWithThese)
{
  const auto far = builtFar(16, 150000);
  ASSERT_TRUE(far);
  ASSERT_GT(far->hierarchy()->nodeCount() * sizeof(Node), std::size_t(1) << 20);
  ASSERT_TRUE(far->read(far->hierarchy()->roots().front(), {}));
  EXPECT_EQ(line_->rounds(), 2u);
  EXPECT_LE(line_->bytes, 2000000u);
}

TEST_F(LateNodes, OfABuiltStoreLieBesideTheirSiblings)
{
  options_.nodePoints = 1000;
  const auto store = build(test::hills(400000, 1e6));
  const std::vector<std::uint64_t> places = placesIn(options_.outputPath);
  const Hierarchy& table = *store->hierarchy();
  std::size_t groups = 0;
  for (NodeIndex n = 0; n < places.size(); ++n)
  {
    const Node node = table.node(n);
    if (node.childCount > 1 && node.pointsBelow - node.pointCount >= lateFrom)
    {
      const auto first = places.begin() + node.firstChild;
      std::vector<std::uint64_t> siblings(first, first + node.childCount);
      std::sort(siblings.begin(), siblings.end());
      const auto between = std::count_if(places.begin(), places.end(),
        [&](std::uint64_t at) { return at > siblings.front() && at < siblings.back(); });
      EXPECT_EQ(between, node.childCount - 2) << n;
      ++groups;
    }
  }
  EXPECT_GT(groups, 10u);
}
} // namespace
} // namespace pointfront
