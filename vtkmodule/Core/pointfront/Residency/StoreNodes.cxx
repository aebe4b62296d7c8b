#include "pointfront/Residency/StoreNodes.h"

#include <algorithm>
#include <cassert>
#include <limits>
#include <new>
#include <string>
#include <utility>

namespace pointfront
{
namespace
{

bool hasAll(const ColumnSelection& present, const ColumnSelection& wanted)
{
  return std::includes(present.begin(), present.end(), wanted.begin(), wanted.end());
}

} // namespace

StoreNodes::StoreNodes(std::shared_ptr<const NodeReader> reader, NodeIndex nodeCount,
  std::shared_ptr<MemoryBudget> budget)
  : reader_(std::move(reader))
  , rows_(reader_->missingRows())
  , nodeCount_(nodeCount)
  , budget_(std::move(budget))
  , cache_(budget_)
  , waiting_(reader_, budget_)
{
  if (rows_ != nullptr)
  {
    rows_->attach(this, [whole = budget_] { whole->announceChange(); });
  }
}

StoreNodes::~StoreNodes()
{
  close();
}

bool StoreNodes::rowsNext(const std::optional<WaitingReads::Choice>& choice) const
{
  return rows_ != nullptr && rows_->waiting() && !(rowsLast_ && choice);
}

/// The node that should be read next and fits.
std::optional<WaitingReads::Choice> StoreNodes::choose() const
{
  return waiting_.choose(cache_, nothingToRelease_ && loading_ == 0);
}

std::optional<StoreNodes::Urgency> StoreNodes::next() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::optional<WaitingReads::Choice> choice = choose();
  if (rowsNext(choice))
  {
    return Urgency{ 0, std::numeric_limits<double>::infinity() };
  }
  return choice ? std::optional<Urgency>({ choice->turn, choice->request.priority }) : std::nullopt;
}

std::optional<StoreNodes::Task> StoreNodes::begin()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::optional<WaitingReads::Choice> choice = choose();
  rowsLast_ = rowsNext(choice);
  if (rowsLast_)
  {
    ++loadingRows_;
    return Task();
  }
  return choice ? beginNode(*choice) : std::nullopt;
}

/// Under the lock.
std::optional<StoreNodes::Task> StoreNodes::beginNode(const WaitingReads::Choice& choice)
{
  const NodeIndex node = choice.request.node;
  Task task{ node, waiting_.columns().of(choice.request.layer), waiting_.need(choice.request),
    choice.reread };
  if (choice.inPlaceOfOld)
  {
    cache_.remove(node);
    ++revision_;
  }
  if (!budget_->reserve(task.bytes))
  {
    return std::nullopt; // another store on the same budget was faster
  }
  waiting_.take(choice);
  CachedNode& cached = cache_[node];
  cached.loading = true;
  cached.stale = cached.drawn = false;
  ++loading_;
  loadingBytes_ += task.bytes;
  return task;
}

bool StoreNodes::idle() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return loading_ == 0 && !choose();
}

bool StoreNodes::loading() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return loading_ > 0 || loadingRows_ > 0;
}

bool StoreNodes::exhausted() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return nothingToRelease_ && loading_ == 0 && !choose();
}

/// A request for what is in memory with other columns.
LoadRequest StoreNodes::again(NodeIndex node, const NodeColumns& points, double priority)
{
  return { node, priority, false, static_cast<std::uint32_t>(points.size()), points.layer };
}

/// False when decodedBytes() had said too little and the rest does not fit: the node waits again.
bool StoreNodes::store(const Task& task, NodeColumns points)
{
  const std::size_t bytes = points.bytes();
  if (bytes > task.bytes && !budget_->reserve(bytes - task.bytes))
  {
    waiting_.learn(task.node, bytes);
    budget_->giveBack(task.bytes);
    return false;
  }
  if (bytes < task.bytes)
  {
    budget_->giveBack(task.bytes - bytes);
  }
  const bool complete = hasAll(points.selection, waiting_.columns().of(points.layer));
  const LoadRequest other = again(task.node, points, 0.0);
  cache_.insert(task.node, std::move(points), bytes);
  if (!complete)
  {
    // Other columns were asked for while it was read.
    cache_[task.node].stale = true;
    waiting_.readAgain(other);
  }
  return true;
}

bool StoreNodes::finish(const Task& task, Result<NodeColumns> result, std::size_t bytesRead)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  CachedNode& cached = cache_[task.node];
  cached.loading = false;
  loadingBytes_ -= task.bytes;
  if (!result.ok() && result.error().kind == Error::Kind::Cancelled)
  {
    forgetCancelled(task);
    return true;
  }
  if (!result.ok())
  {
    budget_->giveBack(task.bytes);
    cache_.remove(task.node);
    markFailed(cached, result.error());
    return true;
  }
  fileFailed_ = false;
  bytesRead_ += bytesRead;
  const std::size_t bytes = result->bytes();
  bool news = false;
  try
  {
    news = store(task, std::move(result).value());
  }
  catch (const std::bad_alloc&)
  {
    cache_.remove(task.node);
    budget_->giveBack(bytes);
    markLacking(cached);
    return true;
  }
  // The new node may be one that can go: it was wanted when its read began.
  nothingToRelease_ = nothingToRelease_ && task.reread;
  if (news)
  {
    ++arrivals_;
    ++revision_;
  }
  return news;
}

void StoreNodes::abandon(const Task& task)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  CachedNode& cached = cache_[task.node];
  cached.loading = false;
  loadingBytes_ -= task.bytes;
  budget_->giveBack(task.bytes);
  cache_.remove(task.node);
  markLacking(cached);
}

void StoreNodes::tell()
{
  const std::lock_guard<std::mutex> lock(arrivedMutex_);
  if (arrived_)
  {
    arrived_();
  }
}

void StoreNodes::leave(const Task& task)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  --(task.node != noNode ? loading_ : loadingRows_);
}

void StoreNodes::close()
{
  setArrivalFunction(nullptr);
  if (rows_ != nullptr)
  {
    rows_->detach(this);
  }
  Gone gone;
  const std::lock_guard<std::mutex> lock(mutex_);
  waiting_.clear();
  cache_.forEach([&](NodeIndex node, CachedNode&) { gone.push_back(cache_.remove(node)); });
}

std::size_t StoreNodes::waitingBytes() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return waiting_.bytes();
}

std::size_t StoreNodes::stayingBytes() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return cache_.bytes() + loadingBytes_;
}

void StoreNodes::offer(
  std::uint32_t number, const NodeCache::Distance& distance, ReleasePlan& plan) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  cache_.forEach(
    [&](NodeIndex node, const CachedNode& cached)
    {
      if (cached.points != nullptr && !cached.loading)
      {
        plan.count(number, node, cached.bytes, distance(node));
      }
    });
}

void StoreNodes::release(NodeIndex node, Gone& gone)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const CachedNode* cached = cache_.find(node);
  if (cached != nullptr && cached->points != nullptr && !cached->loading)
  {
    gone.push_back(cache_.remove(node));
    waiting_.cancelReread(node);
    cache_.forget(node);
    ++released_;
    ++revision_;
  }
}

bool StoreNodes::noteRelease(bool nothingFound)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(nothingToRelease_, nothingFound) != nothingFound;
}

bool StoreNodes::setColumns(const LayerColumns& columns)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (columns == waiting_.columns())
  {
    return false;
  }
  std::vector<LoadRequest> lacking;
  cache_.forEach(
    [&](NodeIndex node, CachedNode& cached)
    {
      // With other columns the read may succeed.
      cached.failed = false;
      cached.tooLarge = false;
      cached.drawn = false;
      cached.stale = !cached.loading && cached.points != nullptr &&
        !hasAll(cached.points->selection, columns.of(cached.points->layer));
      if (cached.stale)
      {
        lacking.push_back(again(node, *cached.points, 0.0));
      }
    });
  waiting_.setColumns(columns, lacking);
  ++revision_;
  return true;
}

LayerColumns StoreNodes::columns() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return waiting_.columns();
}

bool StoreNodes::request(const std::vector<LoadRequest>& requests)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  stopUnwanted(requests);
  std::vector<LoadRequest> wanted;
  wanted.reserve(requests.size());
  for (const LoadRequest& request : requests)
  {
    assert(request.node < nodeCount_);
    const CachedNode* cached = cache_.find(request.node);
    if (cached == nullptr || (!cached->points && !cached->loading && !cached->failed))
    {
      wanted.push_back(request);
    }
  }
  const WaitingReads::Replaced replaced = waiting_.replace(wanted);
  requested_ += replaced.change.added;
  cancelled_ += replaced.change.cancelled;
  for (const auto& [node, bytes] : replaced.tooLarge)
  {
    markTooLarge(node, bytes, replaced.limit);
  }
  if (replaced.change.added == 0 && replaced.change.cancelled == 0)
  {
    return false;
  }
  nothingToRelease_ = false;
  return true;
}

std::shared_ptr<const NodeColumns> StoreNodes::find(NodeIndex node)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  CachedNode* cached = cache_.find(node);
  if (cached == nullptr)
  {
    return nullptr;
  }
  if (cached->stale && !cached->drawn && cached->points)
  {
    cached->drawn = true;
    waiting_.readAgain(again(node, *cached->points, WaitingReads::drawnNow));
  }
  return cached->points;
}

ResidencySnapshot::State StoreNodes::state(NodeIndex node) const
{
  using State = ResidencySnapshot::State;
  const std::lock_guard<std::mutex> lock(mutex_);
  const CachedNode* cached = cache_.find(node);
  if (cached == nullptr)
  {
    return State::Absent;
  }
  return cached->points ? State::Resident : cached->failed ? State::Failed : State::Absent;
}

void StoreNodes::setArrivalFunction(std::function<void()> arrived)
{
  const std::lock_guard<std::mutex> lock(arrivedMutex_);
  arrived_ = std::move(arrived);
}

std::vector<Error> StoreNodes::takeErrors()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return std::exchange(errors_, {});
}

ResidencyStatistics StoreNodes::statistics() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  ResidencyStatistics s;
  s.residentBytes = budget_->used();
  s.residentBytesMax = budget_->usedMax();
  s.residentNodes = cache_.count();
  s.pending = static_cast<std::uint32_t>(waiting_.size());
  s.loading = loading_;
  s.requested = requested_;
  s.cancelled = cancelled_;
  s.failed = failed_;
  s.released = released_;
  s.bytesRead = bytesRead_;
  return s;
}

void StoreNodes::reconsider()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::size_t limit = budget_->limit();
  cache_.forEach(
    [&](NodeIndex node, CachedNode& cached)
    {
      if (cached.tooLarge && waiting_.mayFit(node, limit))
      {
        cached.tooLarge = cached.failed = false;
        ++revision_;
      }
    });
}

} // namespace pointfront
