#pragma once

#include "pointfront/Neighbourhood/InputOrder.h"
#include "pointfront/Neighbourhood/TileLayout.h"
#include "pointfront/Records/RecordPool.h"
#include "pointfront/Threads/WorkCrew.h"

#include <atomic>
#include <bitset>
#include <memory>
#include <mutex>
#include <vector>

namespace pointfront
{

/// Object classes (LAS codes).
using ClassSet = std::bitset<256>;

/// A point in a tile.
struct TilePoint
{
  glm::dvec3 position{ 0.0 };
  std::uint64_t key = 0; ///< object class in the upper 8 bits, number in input order below

  static std::uint64_t keyOf(std::uint64_t number, std::uint8_t objectClass)
  {
    return std::uint64_t(objectClass) << 56 | number;
  }
  std::uint64_t number() const { return key & 0x00ffffffffffffffull; }
  std::uint8_t objectClass() const { return static_cast<std::uint8_t>(key >> 56); }
};

/// The points that take part, by class. Without a column "classification" all points have class 0.
struct Participants
{
  ClassSet queries = ClassSet().set(); ///< those that are given a value
  ClassSet references = ClassSet().set(); ///< those that can be neighbours
};

/// The points of a tile, its own first.
struct GatheredPoints
{
  std::vector<TilePoint> points;
  std::size_t own = 0; ///< points [0, own): all that take part; behind them references of the halo
};

/// The bounds of a tile's references, for searches from other tiles.
struct ReferenceExtent
{
  Bounds bounds;
  std::uint64_t points = 0;
};

/// All points of all sources, distributed once into tiles, each with copies of the references in
/// its halo. In memory, or in one unnamed file when they do not fit.
/// Points that have no place (NaN, infinite, farther than 1e12) are in no tile.
/// Threads  made from one thread, runs on those of the crew; then immutable, read from any thread.
class PointTiles
{
public:
  /// Reads every source twice: to count, and to distribute. Reports the phases "cutting into
  /// tiles" and "distributing", each with `weight` of the whole.
  /// Errors  those of the sources; NoMemory; Unwritable (spill file); BadArgument: halos so wide
  ///         that each point would be copied many times.
  static Result<std::unique_ptr<PointTiles>> make(const PointSources& sources,
    const InputOrder& order, const TilingOptions& tiling, const Participants& participants,
    const PassResources& resources, WorkCrew& crew, double weight);

  const TileLayout& layout() const { return *layout_; }
  std::size_t count() const { return layout_->tiles().size(); }
  const Participants& participants() const { return participants_; }
  const ReferenceExtent& references(std::size_t tile) const { return extents_[tile]; }
  /// How many threads can work on a tile each, with `pointBytes` for each point that it gathers, in
  /// half of the memory. Error NoMemory when not even one can.
  Result<unsigned> threadsFor(std::uint64_t pointBytes, const PassResources& resources) const;
  bool onDisk() const { return pool_->onDisk(); }

  /// The order of the points differs from run to run.
  Result<GatheredPoints> gathered(std::size_t tile) const;
  Result<std::vector<TilePoint>> own(std::size_t tile) const;

private:
  explicit PointTiles(const Participants& participants)
    : participants_(participants)
  {
  }
  class Distribution;
  Result<void> placeTiles(const PassResources& resources);

  Participants participants_;
  std::unique_ptr<TileLayout> layout_;
  std::unique_ptr<RecordPool> pool_;
  std::vector<ReferenceExtent> extents_;
  std::vector<std::uint64_t> begin_; ///< record of each tile's first own point; one more at the end
  std::vector<std::uint64_t> ownCount_;
  std::vector<std::uint64_t> haloCount_; ///< stored behind the room for all own points
};

/// Bytes that a pass may use: those given, or half of the machine's.
std::uint64_t memoryOf(const PassResources& resources);
unsigned threadsOf(const PassResources& resources);

} // namespace pointfront
