#pragma once

#include "pointfront/Base/Progress.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Build/OpenedInputs.h"
#include "pointfront/Points/PointSource.h"
#include "pointfront/Points/QuantisationGrid.h"
#include "pointfront/Store/Hierarchy.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{
class BuildWatch;
class InputBox;

/// The depth of the values in a colour's 16 bits. Files do not say: many have values of 8 bits.
enum class ColourDepth
{
  ByFile, ///< a file whose largest value is at most 255 has 8 bits; beside others it is widened
  Eight, ///< 8 in all files; a larger value is an Error
  Sixteen ///< 16 in all files: stored as they are
};

enum class Structure : std::uint8_t
{
  Octree,
  KdTree ///< balanced, all nodes but one a tree with nodePoints points
};

/// Which points share a tree.
enum class Layering : std::uint8_t
{
  Automatic, ///< ObjectClass if any point has a class other than 0 and 1, else None
  None, ///< all
  ObjectClass ///< those of one value of "classification"
};

struct BuildOptions
{
  std::string outputPath;
  Structure structure = Structure::Octree;
  Layering layering = Layering::None;
  /// Replace: the leaves hold the points, inner nodes mean representatives, and the store gets the
  /// column "enclosing_radius" (float32, world units; MeanRecord.h).
  Refinement refinement = Refinement::Add;
  std::string temporaryFolder; ///< for spill files; empty: the output's folder
  std::uint64_t memoryBytes = 0; ///< budget for points in memory; 0: half of the machine's
  unsigned threads = 0; ///< 0: one a core
  std::uint32_t nodePoints = 16384; ///< capacity of a leaf; inner nodes hold about as many
  std::optional<double> precision; ///< world units a step; nothing: the sources' own (lossless)
  /// Attributes to store, by name; nothing: all.
  std::optional<std::vector<std::string>> attributes;
  ColourDepth colourDepth = ColourDepth::ByFile;
  /// The grid of the coordinates, for a store that is a part of a larger cloud; nothing: chosen
  /// from the sources and the precision.
  std::optional<QuantisationGrid> grid;
  /// The larger cloud has colours of 16 bits: those of 8 bits are widened here too (ByFile).
  bool wideColours = false;
  /// The box that the inputs were cut to, if they were: an input may then have no point left, and
  /// it is an Error if all have none.
  std::shared_ptr<InputBox> box;
  bool overwrite = false; ///< false: an existing output is an Error
  /// Behaviour for an input that has points of which none can be stored.
  OnFault onFault = OnFault::Stop;
  /// An input that was cut short is an Error. Otherwise what is there is stored, and what its
  /// header promised beyond that is counted as missing.
  bool wholeInputs = false;
};

struct BuildReport
{
  std::uint64_t pointsRead = 0;
  std::uint64_t pointsStored = 0;
  /// Reason -> count; a warning tells it too. "missing" counts the points that a header promises
  /// and its file lacks: they were not read.
  std::map<std::string, std::uint64_t> pointsRejected;
  /// Points that were read and lie outside of the options' box; not among pointsRead.
  std::uint64_t pointsOutside = 0;
  std::vector<InputFault> inputsSkipped; ///< they have no point to store (OnFault::Skip)
  double seconds = 0.0;
  std::uint64_t bytesWritten = 0;
  std::uint64_t spilledBytes = 0;
  std::uint64_t nodes = 0;
  std::vector<std::string> warnings; ///< warnings of the sources and of the build; full sentences
  std::map<std::string, double> phaseSeconds; ///< phase -> CPU seconds over all threads
  double cpuSeconds = 0.0; ///< time of the process: the phases and the work between them
};

/// "68125 not a number, 3 infinite"; empty if no point was rejected.
std::string rejectionText(const BuildReport& report);

/// Builds a store from any number of sources; with an octree or a kd-tree, for all points or one
/// for each object class.
/// Guarantees  every point that is read is stored once, or counted in pointsRejected with its
///             reason (NaN, infinite, outside the grid's range); read = stored + rejected is
///             checked at the end, before what is missing is added. An input of which nothing is
///             left is an Error, or is skipped. Same input, same bytes out: for any number of
///             threads and any memory budget. A build that fails or is cancelled leaves no output
///             and no spill files.
/// Memory      points, columns and buffers stay under memoryBytes; with less than needed the
///             points are spilled to disk (a fixed number of files).
/// Threads     called from one thread; runs its own.
/// `watch`     sees the store while its trees are built; the store's bytes do not depend on it.
Result<BuildReport> buildStore(const std::vector<std::unique_ptr<PointSource>>& sources,
  const BuildOptions& options, const ProgressFunction& progress = {}, BuildWatch* watch = nullptr);

} // namespace pointfront
