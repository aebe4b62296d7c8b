#include "pointfront/Front/NodeRequests.h"

#include <algorithm>

namespace pointfront
{
namespace
{

bool sooner(const LoadRequest& a, const LoadRequest& b)
{
  if (a.optional != b.optional)
  {
    return b.optional;
  }
  return a.priority != b.priority ? a.priority > b.priority : a.node < b.node;
}

} // namespace

void NodeRequests::finish(std::size_t most, FrontDelta& delta)
{
  if (wanted_.size() > most)
  {
    const auto end = wanted_.begin() + static_cast<std::ptrdiff_t>(most);
    std::nth_element(wanted_.begin(), end, wanted_.end(), sooner);
    wanted_.erase(end, wanted_.end());
  }
  std::sort(wanted_.begin(), wanted_.end(), sooner);
  delta.requests.assign(wanted_.begin(), wanted_.end());
  delta.failedNodes = failed_;
}

} // namespace pointfront
