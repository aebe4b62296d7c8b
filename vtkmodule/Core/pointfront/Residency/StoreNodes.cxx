#include "pointfront/Residency/StoreNodes.h"

#include <algorithm>
#include <cassert>
#include <limits>
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

/// A node that is drawn with old columns is read again before everything else.
constexpr double drawnNow = 1.0;

constexpr std::size_t mostNeedsKept = 1u << 16;

/// Errors of the file as a whole, not of a node in it: one tells of all.
bool isOfTheFile(const Error& error)
{
  return error.kind == Error::Kind::Unreadable || error.kind == Error::Kind::Truncated ||
    error.kind == Error::Kind::NotFound;
}

} // namespace

StoreNodes::StoreNodes(std::shared_ptr<const NodeReader> reader, NodeIndex nodeCount,
  std::shared_ptr<MemoryBudget> budget)
  : reader_(std::move(reader))
  , rows_(reader_->missingRows())
  , nodeCount_(nodeCount)
  , budget_(std::move(budget))
  , cache_(budget_)
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

std::size_t StoreNodes::need(const LoadRequest& request) const
{
  const auto known = needs_.find(request.node);
  return known != needs_.end()
    ? known->second
    : reader_->decodedBytes(request.node, request.pointCount, columns_.of(request.layer));
}

bool StoreNodes::rowsNext(const std::optional<Choice>& choice) const
{
  return rows_ != nullptr && rows_->waiting() && !(rowsLast_ && choice);
}

/// What should be read next and fits.
std::optional<StoreNodes::Choice> StoreNodes::choose() const
{
  const auto fitting = [this](const RequestQueue& from, auto&& taken) -> const LoadRequest*
  {
    const auto found = std::find_if(from.begin(), from.end(),
      [&](const LoadRequest& r) { return taken(r) && budget_->fits(need(r)); });
    return found != from.end() ? &*found : nullptr;
  };
  const auto drawn = [](const LoadRequest& r) { return r.priority >= drawnNow; };
  const auto needed = [](const LoadRequest& r) { return !r.optional; };
  const auto any = [](const LoadRequest&) { return true; };
  const bool room = budget_->fits(leastNeed_);
  if (const LoadRequest* request = room ? fitting(rereads_, drawn) : nullptr)
  {
    return Choice{ *request, 0, true, false };
  }
  if (const LoadRequest* request = room ? fitting(queue_, needed) : nullptr)
  {
    return Choice{ *request, 1, false, false };
  }
  if (const LoadRequest* request = room ? fitting(rereads_, any) : nullptr)
  {
    return Choice{ *request, 2, true, false };
  }
  if (nothingToRelease_ && loading_ == 0)
  {
    // Not even one more node fits: the old columns go before the new ones come.
    for (const LoadRequest& request : rereads_)
    {
      const CachedNode* cached = cache_.find(request.node);
      if (cached->points.use_count() == 1 && budget_->fits(need(request), cached->bytes))
      {
        return Choice{ request, 3, true, true };
      }
    }
  }
  if (const LoadRequest* request = room ? fitting(queue_, any) : nullptr)
  {
    return Choice{ *request, 4, false, false };
  }
  return std::nullopt;
}

std::optional<StoreNodes::Urgency> StoreNodes::next() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::optional<Choice> choice = choose();
  if (rowsNext(choice))
  {
    return Urgency{ 0, std::numeric_limits<double>::infinity() };
  }
  return choice ? std::optional<Urgency>({ choice->rank, choice->request.priority }) : std::nullopt;
}

std::optional<StoreNodes::Task> StoreNodes::begin()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::optional<Choice> choice = choose();
  rowsLast_ = rowsNext(choice);
  if (rowsLast_)
  {
    ++loadingRows_;
    return Task();
  }
  if (!choice)
  {
    return std::nullopt;
  }
  const NodeIndex node = choice->request.node;
  Task task{ node, columns_.of(choice->request.layer), need(choice->request), choice->reread };
  if (choice->inPlaceOfOld)
  {
    cache_.remove(node);
    ++revision_;
  }
  if (!budget_->reserve(task.bytes))
  {
    return std::nullopt; // another store on the same budget was faster
  }
  (choice->reread ? rereads_ : queue_).cancel(node);
  waitingKnown_ = false;
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

/// A file that cannot be read fails for every node: told once, until a read succeeds again.
void StoreNodes::report(Error error)
{
  if (isOfTheFile(error))
  {
    if (std::exchange(fileFailed_, true))
    {
      return;
    }
    error.what += " (other parts of this file that cannot be read are not listed)";
  }
  errors_.push_back(std::move(error));
}

void StoreNodes::markFailed(CachedNode& cached, Error error)
{
  cached.failed = true;
  cached.stale = false;
  ++failed_;
  ++arrivals_;
  ++revision_;
  report(std::move(error));
}

/// A node that is larger than the whole budget would wait for ever and in silence.
void StoreNodes::refuseTooLarge(const std::vector<LoadRequest>& requests)
{
  const std::size_t limit = budget_->limit();
  for (const LoadRequest& request : requests)
  {
    const std::size_t bytes = need(request);
    if (bytes > limit)
    {
      needs_[request.node] = bytes;
      CachedNode& cached = cache_[request.node];
      cached.tooLarge = true;
      queue_.cancel(request.node);
      markFailed(cached,
        makeError(Error::Kind::NoMemory,
          "node " + std::to_string(request.node) + " takes " + std::to_string(bytes) +
            " bytes in memory, more than the whole budget of " + std::to_string(limit) +
            ": give more memory"));
    }
  }
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
    needs_[task.node] = bytes;
    waitingKnown_ = false;
    budget_->giveBack(task.bytes);
    return false;
  }
  if (bytes < task.bytes)
  {
    budget_->giveBack(task.bytes - bytes);
  }
  const bool complete = hasAll(points.selection, columns_.of(points.layer));
  const LoadRequest other = again(task.node, points, 0.0);
  cache_.insert(task.node, std::move(points), bytes);
  if (!complete)
  {
    // Other columns were asked for while it was read.
    cache_[task.node].stale = true;
    rereads_.add(other);
    waitingKnown_ = false;
    leastNeed_ = std::min(leastNeed_, need(other));
  }
  return true;
}

bool StoreNodes::finish(const Task& task, Result<NodeColumns> result, std::size_t bytesRead)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  CachedNode& cached = cache_[task.node];
  cached.loading = false;
  loadingBytes_ -= task.bytes;
  if (!result.ok())
  {
    budget_->giveBack(task.bytes);
    cache_.remove(task.node);
    markFailed(cached, result.error());
    return true;
  }
  fileFailed_ = false;
  bytesRead_ += bytesRead;
  const bool news = store(task, std::move(result).value());
  // What has come may be what can go: a node that was wanted when its read began.
  nothingToRelease_ = nothingToRelease_ && task.reread;
  if (news)
  {
    ++arrivals_;
    ++revision_;
  }
  return news;
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
  queue_.clear();
  rereads_.clear();
  waitingKnown_ = false;
  cache_.forEach([&](NodeIndex node, CachedNode&) { gone.push_back(cache_.remove(node)); });
}

std::size_t StoreNodes::waitingBytes() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!std::exchange(waitingKnown_, true))
  {
    waiting_ = 0;
    for (const LoadRequest& request : queue_)
    {
      waiting_ += request.optional ? 0 : need(request);
    }
    for (const LoadRequest& request : rereads_)
    {
      waiting_ += need(request);
    }
  }
  return waiting_;
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
    rereads_.cancel(node);
    waitingKnown_ = false;
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
  if (columns == columns_)
  {
    return false;
  }
  columns_ = columns;
  needs_.clear();
  rereads_.clear();
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
  rereads_.replace(lacking);
  noteLeastNeed();
  ++revision_;
  return true;
}

void StoreNodes::noteLeastNeed()
{
  waitingKnown_ = false;
  leastNeed_ = std::numeric_limits<std::size_t>::max();
  for (const RequestQueue* waiting : { &queue_, &rereads_ })
  {
    for (const LoadRequest& request : *waiting)
    {
      leastNeed_ = std::min(leastNeed_, need(request));
    }
  }
}

LayerColumns StoreNodes::columns() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return columns_;
}

bool StoreNodes::request(const std::vector<LoadRequest>& requests)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (needs_.size() > mostNeedsKept)
  {
    needs_.clear();
  }
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
  const RequestQueue::Change change = queue_.replace(wanted);
  requested_ += change.added;
  cancelled_ += change.cancelled;
  waitingKnown_ = false; // priorities, and what is optional, may have changed
  refuseTooLarge(wanted);
  if (change.added == 0 && change.cancelled == 0)
  {
    return false;
  }
  noteLeastNeed();
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
  if (cached->stale && !cached->drawn)
  {
    cached->drawn = true;
    rereads_.add(again(node, *cached->points, drawnNow));
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
  s.pending = static_cast<std::uint32_t>(queue_.size() + rereads_.size());
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
      const auto known = needs_.find(node);
      if (cached.tooLarge && (known == needs_.end() || known->second <= limit))
      {
        cached.tooLarge = cached.failed = false;
        ++revision_;
      }
    });
}

} // namespace pointfront
