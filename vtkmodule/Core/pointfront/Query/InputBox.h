#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Points/PointSource.h"

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace pointfront
{

/// The box that a build takes points from: inputs are cut to it, and what lies outside is counted.
/// Units    world units of the inputs, before a pass moves their points.
/// Exact    a point is inside or on the box as export's query has it: its place on the source's
///          grid counts. A position that is no number is in no box.
/// Threads  any; the sources that it cuts may outlive it.
class InputBox
{
public:
  /// BadArgument: an end is no number, or a corner lies above the other one.
  static Result<std::shared_ptr<InputBox>> make(const Bounds& box);

  const Bounds& bounds() const { return box_; }
  /// The points of a source that lie in the box: as many chunks, each with chunkPoints() at most.
  std::unique_ptr<PointSource> cut(std::unique_ptr<PointSource> source);
  /// An input that is known to lie outside, and is not opened.
  void leaveOut(const Bounds& input);
  /// Takes out sources that are known to have no point in the box. Errors  nothingInside().
  Result<void> keepInside(std::vector<std::unique_ptr<PointSource>>& sources) const;
  /// The error of inputs that have no point in the box: it says where they lie.
  Error nothingInside() const;
  /// Points that were read and lie outside. A point that is read again counts once.
  std::uint64_t pointsOutside() const;

private:
  class CutSource;
  /// Points of each chunk of a source that lie outside; 0 until it is read.
  using OutsideOfChunks = std::vector<std::atomic<std::uint64_t>>;

  explicit InputBox(const Bounds& box)
    : box_(box)
  {
  }

  Bounds box_;
  mutable std::mutex mutex_; // guards what follows
  Bounds inputs_; ///< where the inputs lie, as they say
  std::vector<std::shared_ptr<const OutsideOfChunks>> outside_;
};

} // namespace pointfront
