#include "pointfront/Residency/WaitingReads.h"

#include <algorithm>
#include <limits>

namespace pointfront
{
namespace
{

constexpr std::size_t mostNeedsKept = 1u << 16;

} // namespace

WaitingReads::WaitingReads(
  std::shared_ptr<const NodeReader> reader, std::shared_ptr<const MemoryBudget> budget)
  : reader_(std::move(reader))
  , budget_(std::move(budget))
{
}

void WaitingReads::setColumns(const LayerColumns& columns, const std::vector<LoadRequest>& lacking)
{
  columns_ = columns;
  needs_.clear();
  rereads_.clear(); // all begin to wait now
  rereads_.replace(lacking);
  noteLeastNeed();
}

WaitingReads::Replaced WaitingReads::replace(const std::vector<LoadRequest>& wanted)
{
  if (needs_.size() > mostNeedsKept)
  {
    needs_.clear();
  }
  Replaced replaced;
  replaced.change = queue_.replace(wanted);
  bytesKnown_ = false; // priorities, and what is optional, may have changed
  replaced.limit = budget_->limit();
  for (const LoadRequest& request : wanted)
  {
    const std::size_t bytes = need(request);
    if (bytes > replaced.limit)
    {
      needs_[request.node] = bytes;
      queue_.cancel(request.node);
      replaced.tooLarge.emplace_back(request.node, bytes);
    }
  }
  if (replaced.change.added > 0 || replaced.change.cancelled > 0)
  {
    noteLeastNeed();
  }
  return replaced;
}

void WaitingReads::readAgain(const LoadRequest& request)
{
  if (rereads_.add(request))
  {
    bytesKnown_ = false;
    leastNeed_ = std::min(leastNeed_, need(request));
  }
}

void WaitingReads::cancelReread(NodeIndex node)
{
  rereads_.cancel(node);
  bytesKnown_ = false;
}

std::optional<WaitingReads::Choice> WaitingReads::choose(
  const NodeCache& cache, bool oldMayGo) const
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
  if (oldMayGo)
  {
    // Not even one more node fits: the old columns go before the new ones come.
    for (const LoadRequest& request : rereads_)
    {
      const CachedNode* cached = cache.find(request.node);
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

std::vector<LoadRequest> WaitingReads::near(NodeIndex node, std::uint64_t reach) const
{
  const std::optional<std::uint64_t> begin = reader_->place(node);
  if (!begin)
  {
    return {};
  }
  std::vector<std::pair<std::uint64_t, LoadRequest>> found;
  for (const LoadRequest& request : queue_)
  {
    const std::optional<std::uint64_t> place =
      request.optional ? std::nullopt : reader_->place(request.node);
    const std::uint64_t distance = !place ? reach
      : *place > *begin                   ? *place - *begin
                                          : *begin - *place;
    if (distance < reach)
    {
      found.emplace_back(distance, request);
    }
  }
  std::stable_sort(
    found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<LoadRequest> requests;
  requests.reserve(found.size());
  for (const auto& [distance, request] : found)
  {
    requests.push_back(request);
  }
  return requests;
}

void WaitingReads::take(const Choice& choice)
{
  (choice.reread ? rereads_ : queue_).cancel(choice.request.node);
  bytesKnown_ = false;
}

void WaitingReads::clear()
{
  queue_.clear();
  rereads_.clear();
  bytesKnown_ = false;
}

std::size_t WaitingReads::need(const LoadRequest& request) const
{
  const auto known = needs_.find(request.node);
  return known != needs_.end()
    ? known->second
    : reader_->decodedBytes(request.node, request.pointCount, columns_.of(request.layer));
}

void WaitingReads::learn(NodeIndex node, std::size_t bytes)
{
  needs_[node] = bytes;
  bytesKnown_ = false;
}

bool WaitingReads::mayFit(NodeIndex node, std::size_t limit) const
{
  const auto known = needs_.find(node);
  return known == needs_.end() || known->second <= limit;
}

std::size_t WaitingReads::bytes() const
{
  if (!std::exchange(bytesKnown_, true))
  {
    bytes_ = 0;
    for (const LoadRequest& request : queue_)
    {
      bytes_ += request.optional ? 0 : need(request);
    }
    for (const LoadRequest& request : rereads_)
    {
      bytes_ += need(request);
    }
  }
  return bytes_;
}

void WaitingReads::noteLeastNeed()
{
  bytesKnown_ = false;
  leastNeed_ = std::numeric_limits<std::size_t>::max();
  for (const RequestQueue* waiting : { &queue_, &rereads_ })
  {
    for (const LoadRequest& request : *waiting)
    {
      leastNeed_ = std::min(leastNeed_, need(request));
    }
  }
}

} // namespace pointfront
