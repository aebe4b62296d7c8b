#include "pointfront/Query/GroupedFetch.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

namespace pointfront
{
namespace
{
/// A group of a source that does not say how much it should be has so many bytes.
constexpr std::size_t usualGroupBytes = std::size_t(1) << 20;
} // namespace

GroupedFetch::GroupedFetch(const NodeReader& reader, std::vector<WantedNode> wanted,
  const std::vector<std::size_t>& bytes, ReadStop& stop)
  : reader_(reader)
  , wanted_(std::move(wanted))
  , stop_(stop)
{
  assert(bytes.size() == wanted_.size());
  const ReadCost cost = reader_.readCost();
  const std::size_t enough = cost.bytesAtOnce > 0 ? cost.bytesAtOnce : usualGroupBytes;
  std::size_t sum = enough; // the first node begins a group
  for (std::size_t i = 0; i < wanted_.size(); ++i)
  {
    if (sum >= enough)
    {
      groups_.emplace_back().first = i;
      sum = 0;
    }
    ++groups_.back().count;
    sum += bytes[i];
  }
  const std::size_t atOnce =
    std::min({ std::max<std::size_t>(cost.readsAtOnce, 1), groups_.size(), mostAtOnce });
  for (std::size_t t = 0; t < atOnce; ++t)
  {
    threads_.push_back(std::make_unique<WorkerThread>());
    if (!threads_.back()->start([this] { work(); }))
    {
      threads_.pop_back();
      break;
    }
  }
}

GroupedFetch::~GroupedFetch()
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (given_ < groups_.size())
    {
      stop_ = true;
    }
    begun_ = groups_.size();
  }
  threads_.clear();
}

void GroupedFetch::fetch(Group& group) const
{
  try
  {
    const auto first = wanted_.begin() + static_cast<std::ptrdiff_t>(group.first);
    group.fetched =
      reader_.fetchAll({ first, first + static_cast<std::ptrdiff_t>(group.count) }, stop_);
    assert(group.fetched.size() == group.count);
  }
  catch (...)
  {
    group.fault = std::current_exception();
  }
}

void GroupedFetch::work()
{
  std::unique_lock<std::mutex> lock(mutex_);
  while (begun_ < groups_.size())
  {
    Group& group = groups_[begun_++];
    lock.unlock();
    fetch(group);
    lock.lock();
    group.done = true;
    come_.notify_one();
  }
}

std::vector<Result<FetchedNode>> GroupedFetch::next()
{
  std::vector<Result<FetchedNode>> nodes;
  std::unique_lock<std::mutex> lock(mutex_);
  if (given_ == groups_.size())
  {
    return nodes;
  }
  if (threads_.empty())
  {
    Group& group = groups_[begun_++];
    fetch(group);
    group.done = true;
  }
  come_.wait(lock, [this] { return groups_[given_].done; });
  for (; given_ < groups_.size() && groups_[given_].done; ++given_)
  {
    Group& group = groups_[given_];
    if (group.fault)
    {
      std::rethrow_exception(group.fault);
    }
    std::move(group.fetched.begin(), group.fetched.end(), std::back_inserter(nodes));
    std::vector<Result<FetchedNode>>().swap(group.fetched);
  }
  return nodes;
}

} // namespace pointfront
