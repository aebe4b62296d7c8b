#pragma once

#include "pointfront/Front/FrontDelta.h"

#include <cstdint>

namespace pointfront
{

/// The state of the residency that the updates of a selection saw, and whether it can still bring
/// the nodes that they miss.
/// Threads  one.
class SeenResidency
{
public:
  /// Since the last update, which missed so many nodes, nothing came and the memory did not fill.
  bool unchanged(const ResidencySnapshot& now, std::uint32_t missing) const
  {
    return revision_ != 0 && revision_ == now.revision() &&
      exhausted_ == (missing > 0 && now.exhausted());
  }

  /// Before an update asks anything: what arrives while it looks is news to the next one.
  void begin(const ResidencySnapshot& now)
  {
    const std::uint64_t revision = now.revision();
    sameRevision_ = revision_ == revision;
    revision_ = revision;
  }
  /// When it has asked. The residency speaks of what it was asked for after an earlier update: of
  /// the same view (`sameView`)? And nothing came since that one looked: the requests are the same.
  void finish(const ResidencySnapshot& now, bool sameView, std::uint32_t missing)
  {
    exhausted_ =
      sameView && sameRevision_ && missing > 0 && now.exhausted() && now.revision() == revision_;
  }

  /// Whether no node that the last update requested can come any more.
  bool exhausted() const { return exhausted_; }

private:
  std::uint64_t revision_ = 0; ///< before the last update asked anything
  bool sameRevision_ = false; ///< as in the update before that
  bool exhausted_ = false;
};

} // namespace pointfront
