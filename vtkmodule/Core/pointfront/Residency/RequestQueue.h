#pragma once

#include "pointfront/Front/RenderFront.h"

#include <cstddef>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace pointfront
{

/// The requests that wait to be loaded, most urgent first: needed before optional, then by priority
/// (the projected error), then by age, then by node. A request keeps its age while it stays wanted.
/// Threads  none of its own: the owner locks.
class RequestQueue
{
public:
  struct Change
  {
    std::uint32_t added = 0;
    std::uint32_t cancelled = 0;
  };
  using Iterator = std::vector<LoadRequest>::const_iterator;

  /// Takes the new wish list: requests that are not in it are cancelled (FRONT-9), the others get
  /// their new priority.
  Change replace(const std::vector<LoadRequest>& wanted);
  /// Adds one, or changes its priority; true when it is new.
  bool add(const LoadRequest& request);
  /// True when it was waiting.
  bool cancel(NodeIndex node);
  void clear();

  std::size_t size() const { return requests_.size(); }
  bool empty() const { return requests_.empty(); }
  bool contains(NodeIndex node) const { return since_.count(node) > 0; }
  /// All requests, in the order in which they should be loaded.
  Iterator begin() const { return requests_.begin(); }
  Iterator end() const { return requests_.end(); }

private:
  bool sooner(const LoadRequest& a, const LoadRequest& b) const;

  std::vector<LoadRequest> requests_;
  std::unordered_map<NodeIndex, std::uint64_t> since_; ///< number of the call that brought it
  std::uint64_t calls_ = 0;
};

} // namespace pointfront
