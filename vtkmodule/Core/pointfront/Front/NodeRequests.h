#pragma once

#include "pointfront/Front/FrontDelta.h"

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// The nodes that an update needs and does not find in memory: those that it asks for, and how many
/// there are.
/// Order    of the requests: that of FrontDelta.
/// Memory   of the longest list so far: in the steady state nothing is allocated.
/// Threads  one.
class NodeRequests
{
public:
  /// Forgets the update before. `residency` must outlive this one.
  void begin(const ResidencySnapshot& residency)
  {
    residency_ = &residency;
    wanted_.clear();
    missing_ = 0;
    failed_ = 0;
  }

  /// A node that the view needs: asked for if it is absent, counted if it failed.
  ResidencySnapshot::State require(const LoadRequest& request)
  {
    const ResidencySnapshot::State state = residency_->state(request.node);
    if (state == ResidencySnapshot::State::Absent)
    {
      ++missing_;
      wanted_.push_back(request);
    }
    failed_ += state == ResidencySnapshot::State::Failed ? 1 : 0;
    return state;
  }
  /// A node that another view may need.
  void prefetch(LoadRequest request)
  {
    if (residency_->state(request.node) == ResidencySnapshot::State::Absent)
    {
      request.optional = true;
      wanted_.push_back(request);
    }
  }
  /// A node that the view needs, and whose row cannot be read.
  void countFailed() { ++failed_; }

  /// Fills requests, `most` of them at the most, and failedNodes.
  void finish(std::size_t most, FrontDelta& delta);

  /// Nodes that the view needs and that are neither resident nor failed.
  std::uint32_t missing() const { return missing_; }

private:
  const ResidencySnapshot* residency_ = nullptr;
  std::vector<LoadRequest> wanted_;
  std::uint32_t missing_ = 0;
  std::uint32_t failed_ = 0;
};

} // namespace pointfront
