#include "pointfront/Residency/Residency.h"

#include "pointfront/Residency/MemoryBudget.h"
#include "pointfront/Residency/NodeCache.h"
#include "pointfront/Residency/RequestQueue.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <exception>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#if defined(__linux__)
#include <sys/resource.h>
#include <unistd.h>
#endif

namespace pointfront
{
namespace
{

/// FRONT-9: loading must not disturb the drawing. A hint: where it is refused nothing is lost.
void lowerThreadPriority()
{
#if defined(__linux__)
  constexpr int niceness = 5;
  static_cast<void>(setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), niceness));
#endif
}

bool hasAll(const ColumnSelection& present, const ColumnSelection& wanted)
{
  return std::includes(present.begin(), present.end(), wanted.begin(), wanted.end());
}

/// A node that is drawn with old columns is read again before everything else.
constexpr double drawnNow = 1.0;

} // namespace

struct Residency::Content
{
  struct Task
  {
    NodeIndex node = noNode;
    ColumnSelection columns;
    std::size_t bytes = 0; ///< reserved for it
    bool reread = false;   ///< of a node that is or was in memory with other columns
  };
  struct Choice
  {
    LoadRequest request;
    bool reread = false;
    bool inPlaceOfOld = false; ///< fits only after the node's old points are gone
  };

  Content(std::shared_ptr<const NodeReader> nodeReader, NodeIndex count, std::size_t budgetBytes)
    : reader(std::move(nodeReader))
    , nodeCount(count)
    , budget(std::make_shared<MemoryBudget>(budgetBytes))
    , cache(budget)
  {
  }

  const std::shared_ptr<const NodeReader> reader;
  const NodeIndex nodeCount;
  /// Shared with the points that are out: they may be dropped after this object is gone.
  const std::shared_ptr<MemoryBudget> budget;
  std::vector<std::thread> loaders;

  mutable std::mutex mutex; ///< of all below; never held while a node is read
  NodeCache cache;
  RequestQueue queue;
  RequestQueue rereads;
  ColumnSelection columns;
  std::vector<Error> errors;
  std::unordered_map<NodeIndex, std::size_t> trueBytes; ///< where decodedBytes() said too little
  std::size_t loadingBytes = 0;
  std::uint32_t loading = 0;
  bool nothingToRelease = false; ///< found by the last release() that room was wanted from
  bool stopped = false;
  std::uint64_t requested = 0;
  std::uint64_t cancelled = 0;
  std::uint64_t failed = 0;
  std::uint64_t released = 0;
  std::uint64_t bytesRead = 0;

  std::atomic<std::uint64_t> arrivals{ 0 };
  std::atomic<std::uint64_t> revision{ 1 };
  std::mutex arrivedMutex; ///< held while `arrived` runs
  std::function<void()> arrived;

  // With `mutex` locked:
  std::size_t need(NodeIndex node) const;
  std::optional<Choice> choose() const;
  std::optional<Task> begin();
  bool idle() const;
  void markFailed(CachedNode& cached, Error error);
  void refuseTooLarge(const std::vector<LoadRequest>& requests);
  bool store(const Task& task, NodeColumns points);
  std::size_t bytesWanted() const;

  void load();
  void perform(const Task& task);
  /// Until `reached` or idle.
  template <typename Condition>
  void wait(Condition reached) const;
};

std::size_t Residency::Content::need(NodeIndex node) const
{
  const auto known = trueBytes.find(node);
  const std::size_t promised = reader->decodedBytes(node, columns);
  return known != trueBytes.end() ? std::max(known->second, promised) : promised;
}

/// What should be read next and fits.
std::optional<Residency::Content::Choice> Residency::Content::choose() const
{
  const auto fitting = [this](const RequestQueue& from, auto&& taken) -> const LoadRequest*
  {
    const auto found = std::find_if(from.begin(), from.end(),
      [&](const LoadRequest& r) { return taken(r) && budget->fits(need(r.node)); });
    return found != from.end() ? &*found : nullptr;
  };
  const auto drawn = [](const LoadRequest& r) { return r.priority >= drawnNow; };
  const auto needed = [](const LoadRequest& r) { return !r.optional; };
  const auto any = [](const LoadRequest&) { return true; };
  if (const LoadRequest* request = fitting(rereads, drawn))
  {
    return Choice{ *request, true, false };
  }
  if (const LoadRequest* request = fitting(queue, needed))
  {
    return Choice{ *request, false, false };
  }
  if (const LoadRequest* request = fitting(rereads, any))
  {
    return Choice{ *request, true, false };
  }
  if (nothingToRelease && loading == 0)
  {
    // Not even one more node fits: the old columns go before the new ones come.
    for (const LoadRequest& request : rereads)
    {
      const CachedNode* cached = cache.find(request.node);
      if (cached->points.use_count() == 1 && need(request.node) <= budget->limit() &&
        budget->used() - cached->bytes <= budget->limit() - need(request.node))
      {
        return Choice{ request, true, true };
      }
    }
  }
  if (const LoadRequest* request = fitting(queue, any))
  {
    return Choice{ *request, false, false };
  }
  return std::nullopt;
}

std::optional<Residency::Content::Task> Residency::Content::begin()
{
  const std::optional<Choice> choice = choose();
  if (!choice)
  {
    return std::nullopt;
  }
  const NodeIndex node = choice->request.node;
  Task task{ node, columns, need(node), choice->reread };
  if (choice->inPlaceOfOld)
  {
    cache.remove(node);
    ++revision;
  }
  if (!budget->reserve(task.bytes))
  {
    return std::nullopt; // another residency on the same budget was faster
  }
  (choice->reread ? rereads : queue).cancel(node);
  CachedNode& cached = cache[node];
  cached.loading = true;
  cached.stale = cached.drawn = false;
  ++loading;
  loadingBytes += task.bytes;
  return task;
}

bool Residency::Content::idle() const
{
  return loading == 0 && !choose();
}

void Residency::Content::markFailed(CachedNode& cached, Error error)
{
  cached.failed = true;
  cached.stale = false;
  ++failed;
  ++arrivals;
  ++revision;
  errors.push_back(std::move(error));
}

/// A node that is larger than the whole budget would wait for ever and in silence.
void Residency::Content::refuseTooLarge(const std::vector<LoadRequest>& requests)
{
  for (const LoadRequest& request : requests)
  {
    const std::size_t bytes = need(request.node);
    if (bytes > budget->limit())
    {
      CachedNode& cached = cache[request.node];
      cached.tooLarge = true;
      queue.cancel(request.node);
      markFailed(cached,
        makeError(Error::Kind::NoMemory,
          "node " + std::to_string(request.node) + " takes " + std::to_string(bytes) +
            " bytes in memory, more than the whole budget of " + std::to_string(budget->limit()) +
            ": give more memory"));
    }
  }
}

/// False when decodedBytes() had said too little and the rest does not fit: the node waits again.
bool Residency::Content::store(const Task& task, NodeColumns points)
{
  const std::size_t bytes = points.bytes();
  if (bytes > task.bytes && !budget->reserve(bytes - task.bytes))
  {
    trueBytes[task.node] = bytes;
    budget->giveBack(task.bytes);
    return false;
  }
  if (bytes < task.bytes)
  {
    budget->giveBack(task.bytes - bytes);
  }
  const bool complete = hasAll(points.selection, columns);
  cache.insert(task.node, std::move(points), bytes);
  if (!complete)
  {
    // Other columns were asked for while it was read.
    cache[task.node].stale = true;
    rereads.add({ task.node, 0.0, false });
  }
  return true;
}

void Residency::Content::perform(const Task& task)
{
  Result<NodeColumns> result =
    makeError(Error::Kind::NoMemory, "node " + std::to_string(task.node) + ": no memory to decode");
  try
  {
    result = reader->read(task.node, task.columns);
  }
  catch (const std::bad_alloc&)
  {
    // `result` says so already.
  }
  catch (const std::exception& exception)
  {
    result = makeError(Error::Kind::Unreadable,
      "node " + std::to_string(task.node) + ": " + exception.what());
  }

  bool news = true;
  {
    const std::lock_guard<std::mutex> lock(mutex);
    CachedNode& cached = cache[task.node];
    cached.loading = false;
    loadingBytes -= task.bytes;
    if (result.ok())
    {
      bytesRead += reader->storedBytes(task.node, task.columns);
      news = store(task, std::move(result).value());
      // What has come may be what can go: a node that was wanted when its read began.
      nothingToRelease = nothingToRelease && task.reread;
      if (news)
      {
        ++arrivals;
        ++revision;
      }
    }
    else
    {
      budget->giveBack(task.bytes);
      cache.remove(task.node);
      markFailed(cached, result.error());
    }
  }
  budget->announceChange();
  if (news)
  {
    const std::lock_guard<std::mutex> lock(arrivedMutex);
    if (arrived)
    {
      arrived();
    }
  }
  {
    // Only now: who waits until nothing is loading may count on all having been told.
    const std::lock_guard<std::mutex> lock(mutex);
    --loading;
  }
  budget->announceChange();
}

void Residency::Content::load()
{
  lowerThreadPriority();
  while (true)
  {
    const std::uint64_t seen = budget->changes();
    std::optional<Task> task;
    {
      const std::lock_guard<std::mutex> lock(mutex);
      if (stopped)
      {
        return;
      }
      task = begin();
    }
    if (task)
    {
      perform(*task);
    }
    else
    {
      budget->waitForChange(seen);
    }
  }
}

/// Bytes that must be freed for what waits; what is released but still held somewhere is on its
/// way already.
std::size_t Residency::Content::bytesWanted() const
{
  std::size_t wanted = 0;
  for (const LoadRequest& request : queue)
  {
    wanted += request.optional ? 0 : need(request.node);
  }
  for (const LoadRequest& request : rereads)
  {
    wanted += need(request.node);
  }
  const std::size_t staying = cache.bytes() + loadingBytes;
  const std::size_t limit = budget->limit();
  return wanted + staying > limit ? wanted + staying - limit : 0;
}

template <typename Condition>
void Residency::Content::wait(Condition reached) const
{
  while (true)
  {
    const std::uint64_t seen = budget->changes();
    {
      const std::lock_guard<std::mutex> lock(mutex);
      if (reached() || idle())
      {
        return;
      }
    }
    budget->waitForChange(seen);
  }
}

Residency::Residency(
  std::shared_ptr<const NodeReader> reader, NodeIndex nodeCount, ResidencyOptions options)
  : content_(std::make_unique<Content>(std::move(reader), nodeCount, options.budgetBytes))
{
  for (unsigned loader = 0; loader < std::max(options.loaderThreads, 1u); ++loader)
  {
    content_->loaders.emplace_back([content = content_.get()] { content->load(); });
  }
}

Residency::~Residency()
{
  {
    const std::lock_guard<std::mutex> lock(content_->mutex);
    content_->stopped = true;
  }
  content_->budget->announceChange();
  for (std::thread& loader : content_->loaders)
  {
    loader.join();
  }
}

void Residency::setColumns(const ColumnSelection& columns)
{
  {
    const std::lock_guard<std::mutex> lock(content_->mutex);
    Content& c = *content_;
    if (columns == c.columns)
    {
      return;
    }
    c.columns = columns;
    c.trueBytes.clear();
    c.rereads.clear();
    std::vector<LoadRequest> lacking;
    c.cache.forEach(
      [&](NodeIndex node, CachedNode& cached)
      {
        // With other columns the read may succeed.
        cached.failed = false;
        cached.tooLarge = false;
        cached.drawn = false;
        cached.stale = !cached.loading && cached.points != nullptr &&
          !hasAll(cached.points->selection, columns);
        if (cached.stale)
        {
          lacking.push_back({ node, 0.0, false });
        }
      });
    c.rereads.replace(lacking);
    ++c.revision;
  }
  content_->budget->announceChange();
}

ColumnSelection Residency::columns() const
{
  const std::lock_guard<std::mutex> lock(content_->mutex);
  return content_->columns;
}

void Residency::request(const std::vector<LoadRequest>& requests)
{
  {
    const std::lock_guard<std::mutex> lock(content_->mutex);
    Content& c = *content_;
    std::vector<LoadRequest> wanted;
    wanted.reserve(requests.size());
    for (const LoadRequest& request : requests)
    {
      assert(request.node < c.nodeCount);
      const CachedNode* cached = c.cache.find(request.node);
      if (cached == nullptr || (!cached->points && !cached->loading && !cached->failed))
      {
        wanted.push_back(request);
      }
    }
    const RequestQueue::Change change = c.queue.replace(wanted);
    c.requested += change.added;
    c.cancelled += change.cancelled;
    c.refuseTooLarge(wanted);
    if (change.added == 0 && change.cancelled == 0)
    {
      return;
    }
    c.nothingToRelease = false;
  }
  content_->budget->announceChange();
}

void Residency::release(const std::function<std::uint32_t(NodeIndex)>& distance)
{
  std::vector<std::shared_ptr<const NodeColumns>> gone; // dropped after the lock
  {
    const std::lock_guard<std::mutex> lock(content_->mutex);
    Content& c = *content_;
    const std::size_t wanted = c.bytesWanted();
    const bool before = c.nothingToRelease;
    c.nothingToRelease = false;
    if (wanted > 0)
    {
      const std::vector<NodeIndex> chosen = c.cache.farthest(wanted, distance);
      c.nothingToRelease = chosen.empty();
      for (const NodeIndex node : chosen)
      {
        gone.push_back(c.cache.remove(node));
        c.rereads.cancel(node);
        c.cache.forget(node);
      }
      c.released += chosen.size();
      c.revision += chosen.empty() ? 0 : 1;
    }
    if (gone.empty() && c.nothingToRelease == before)
    {
      return;
    }
  }
  gone.clear();
  content_->budget->announceChange();
}

std::shared_ptr<const NodeColumns> Residency::find(NodeIndex node) const
{
  const std::lock_guard<std::mutex> lock(content_->mutex);
  CachedNode* cached = content_->cache.find(node);
  if (cached == nullptr)
  {
    return nullptr;
  }
  if (cached->stale && !cached->drawn)
  {
    cached->drawn = true;
    content_->rereads.add({ node, drawnNow, false });
  }
  return cached->points;
}

ResidencyView::State Residency::state(NodeIndex node) const
{
  const std::lock_guard<std::mutex> lock(content_->mutex);
  const CachedNode* cached = content_->cache.find(node);
  if (cached == nullptr)
  {
    return State::Absent;
  }
  return cached->points ? State::Resident : cached->failed ? State::Failed : State::Absent;
}

std::uint64_t Residency::revision() const
{
  return content_->revision;
}

bool Residency::exhausted() const
{
  const std::lock_guard<std::mutex> lock(content_->mutex);
  return content_->nothingToRelease && content_->idle();
}

void Residency::setArrivalFunction(std::function<void()> arrived)
{
  const std::lock_guard<std::mutex> lock(content_->arrivedMutex);
  content_->arrived = std::move(arrived);
}

std::uint64_t Residency::arrivals() const
{
  return content_->arrivals;
}

void Residency::waitUntilIdle() const
{
  content_->wait([] { return false; });
}

void Residency::waitForArrival(std::uint64_t seen) const
{
  content_->wait([&] { return content_->arrivals != seen; });
}

std::vector<Error> Residency::takeErrors()
{
  const std::lock_guard<std::mutex> lock(content_->mutex);
  return std::exchange(content_->errors, {});
}

ResidencyStatistics Residency::statistics() const
{
  const std::lock_guard<std::mutex> lock(content_->mutex);
  const Content& c = *content_;
  ResidencyStatistics s;
  s.residentBytes = c.budget->used();
  s.residentBytesMax = c.budget->usedMax();
  s.residentNodes = c.cache.count();
  s.pending = static_cast<std::uint32_t>(c.queue.size() + c.rereads.size());
  s.loading = c.loading;
  s.requested = c.requested;
  s.cancelled = c.cancelled;
  s.failed = c.failed;
  s.released = c.released;
  s.bytesRead = c.bytesRead;
  return s;
}

void Residency::setBudgetBytes(std::size_t bytes)
{
  {
    const std::lock_guard<std::mutex> lock(content_->mutex);
    content_->cache.forEach(
      [&](NodeIndex node, CachedNode& cached)
      {
        if (cached.tooLarge && content_->need(node) <= bytes)
        {
          cached.tooLarge = cached.failed = false;
          ++content_->revision;
        }
      });
  }
  content_->budget->setLimit(bytes);
}

} // namespace pointfront
