#pragma once

#include "pointfront/Base/Progress.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Points/PointSource.h"

#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

using PointSources = std::vector<std::unique_ptr<PointSource>>;
class KnownRegion;

/// The resources that a pass may use.
struct PassResources
{
  std::uint64_t memoryBytes = 0; ///< for points and buffers; 0: half of the machine's
  unsigned threads = 0; ///< 0: one a core
  std::string temporaryFolder; ///< for files that are unlinked as soon as they are open
  ProgressFunction progress; ///< may be empty; false cancels
  /// For sources that are a part of a cloud: says which values are wanted (a pass may leave out the
  /// others, and give anything for them), and gets how far each of these looks. Null: the sources
  /// are all of the cloud. Outlives the sources that a pass gives.
  KnownRegion* known = nullptr;
};

/// Gives points attributes that their source lacks: normals, heights, colours, other coordinates.
/// It runs between the sources and the build, on all sources together, so what it computes cannot
/// depend on where a tree cuts the cloud into parts.
/// Order       the result has the same number of sources, in the same order; each with the same
///             chunks as its original and the same points in them. So results still depend on the
///             input order.
/// Columns     new columns come behind those of the source's schema, or replace a column of the
///             same name. A value that depends on one point alone is computed in read(). A value
///             that needs neighbours is computed by apply() into a temporary column file, under
///             memoryBytes.
/// Threads     apply() is called from one thread and runs its own; the sources it gives keep
///             PointSource's promises.
/// Errors      apply(): what, where, what to try; Error::Kind::Cancelled leaves nothing behind.
class AttributePass
{
public:
  virtual ~AttributePass() = default;
  virtual Result<PointSources> apply(
    PointSources sources, const PassResources& resources) const = 0;

  /// False if apply() only wraps the sources. True if it reads points, which takes time: the first
  /// preview of the cloud is then shown before.
  virtual bool readsPoints() const { return true; }
  /// How far away, horizontally, points can lie that a value depends on, in world units. 0: it
  /// depends on points of its own chunk only; infinite: neighbours are looked for until they are
  /// found, and PassResources::known is told how far that was.
  virtual double reach() const
  {
    return readsPoints() ? std::numeric_limits<double>::infinity() : 0.0;
  }
  /// Memory in bytes that the sources it gives keep while they are read (a cache of images). The
  /// build has that much less of resources.memoryBytes.
  virtual std::uint64_t heldBytes(const PassResources& resources) const
  {
    (void)resources;
    return 0;
  }
  /// Files that it reads besides the sources: none of them may be written over.
  virtual std::vector<std::string> filesRead() const { return {}; }
  /// Faults that it met and survived: full sentences that count what was lost. Called after
  /// apply(), and again after the sources have been read; a repeated sentence is told once.
  virtual std::vector<std::string> findings() const { return {}; }
  /// Whether findings() are of the inputs, not of their points: who builds a cloud in parts meets
  /// the same sentences in each.
  virtual bool findsInputs() const { return false; }
};

using AttributePasses = std::vector<std::unique_ptr<AttributePass>>; ///< in the order they run in

} // namespace pointfront
