#include "pointfront/Residency/LoadJob.h"

#include "pointfront/Base/CpuClock.h"

#include <exception>
#include <new>
#include <string>
#include <utility>

namespace pointfront
{
namespace
{

/// Nodes of one job at most.
constexpr std::size_t mostNodes = 64;

/// Calls `step`; an exception becomes an Error that names the node.
template <typename Step>
auto guarded(NodeIndex node, const Step& step) -> decltype(step())
{
  const std::string name = "node " + std::to_string(node);
  try
  {
    return step();
  }
  catch (const std::bad_alloc&)
  {
    return makeError(Error::Kind::NoMemory, name + ": no memory to decode");
  }
  catch (const std::exception& exception)
  {
    return makeError(Error::Kind::Corrupt, name + ": " + exception.what());
  }
}

} // namespace

LoadJob::LoadJob(std::shared_ptr<StoreNodes> store, bool far, std::size_t bytes)
  : store_(std::move(store))
{
  // A node counts as loading from here on. So nothing may run out of memory before somebody sees
  // to it that this ends.
  tasks_.reserve(far ? mostNodes : 1);
  try
  {
    if (far)
    {
      stop_ = std::make_shared<ReadStop>(false);
      store_->beginBatch(bytes, mostNodes, stop_, tasks_);
    }
    else if (std::optional<StoreNodes::Task> task = store_->begin())
    {
      tasks_.push_back(std::move(*task));
    }
  }
  catch (...)
  {
    giveUp();
    throw;
  }
}

void LoadJob::giveUp()
{
  for (; kept_ < tasks_.size(); ++kept_)
  {
    if (tasks_[kept_].node != noNode) // rows are still missing
    {
      store_->abandon(tasks_[kept_]);
    }
  }
  for (; left_ < tasks_.size(); ++left_)
  {
    store_->leave(tasks_[left_]);
  }
}

void LoadJob::run(Listener& listener)
{
  // Whatever runs out of memory here, be it the words of an Error: who waits for the end of the
  // loading must not wait for ever.
  try
  {
    tasks_.front().node == noNode ? readRows(listener) : loadNodes(listener);
  }
  catch (...)
  {
    if (fetching_)
    {
      endFetch(listener, 0);
    }
    giveUp();
    listener.changed();
    throw;
  }
}

void LoadJob::endFetch(Listener& listener, std::size_t bytes)
{
  fetching_ = false;
  listener.fetched(bytes);
}

/// The table keeps what was read, and tells who waits.
void LoadJob::readRows(Listener& listener)
{
  endFetch(listener, store_->reader().missingRows()->readNext());
  ++kept_;
  store_->leave(tasks_[left_++]);
  listener.changed();
}

std::vector<Result<FetchedNode>> LoadJob::fetch() const
{
  const NodeReader& reader = store_->reader();
  const StoreNodes::Task& first = tasks_.front();
  std::vector<Result<FetchedNode>> fetched;
  if (!stop_)
  {
    fetched.push_back(guarded(first.node, [&] { return reader.fetch(first.node, first.columns); }));
    return fetched;
  }
  std::vector<WantedNode> wanted;
  for (const StoreNodes::Task& task : tasks_)
  {
    wanted.push_back({ task.node, task.columns });
  }
  using All = Result<std::vector<Result<FetchedNode>>>;
  All all = guarded(first.node, [&] { return All(reader.fetchAll(wanted, *stop_)); });
  if (all)
  {
    fetched = std::move(*all);
  }
  while (fetched.size() < tasks_.size())
  {
    fetched.emplace_back(all.error());
  }
  return fetched;
}

void LoadJob::loadNodes(Listener& listener)
{
  std::vector<Result<FetchedNode>> fetched = fetch();
  std::size_t bytes = 0;
  for (const Result<FetchedNode>& node : fetched)
  {
    bytes += node ? node->bytesRead : 0;
  }
  endFetch(listener, bytes);
  for (Result<FetchedNode>& node : fetched)
  {
    finish(std::exchange(node, makeError(Error::Kind::Cancelled, "decoded")), listener);
  }
}

/// Decodes the next node.
void LoadJob::finish(Result<FetchedNode> fetched, Listener& listener)
{
  const StoreNodes::Task& task = tasks_[kept_];
  const std::size_t bytesRead = fetched ? fetched->bytesRead : 0;
  const double begin = threadSeconds();
  Result<NodeColumns> result = fetched
    ? guarded(task.node, [&] { return store_->reader().decode(*fetched); })
    : Result<NodeColumns>(fetched.error());
  const double seconds = threadSeconds() - begin;
  fetched = makeError(Error::Kind::Cancelled, "decoded"); // its bytes go before anyone is told
  listener.decoded(seconds, result ? result->bytes() : 0);
  ++kept_;
  const bool news = store_->finish(task, std::move(result), bytesRead);
  listener.changed();
  if (news)
  {
    store_->tell();
  }
  // Only now: who waits until nothing is loading may count on all having been told.
  store_->leave(task);
  ++left_;
  listener.changed();
}

} // namespace pointfront
