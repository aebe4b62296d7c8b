#pragma once

#include "MosaicFiles.h"
#include "TilesProgress.h"

#include "pointfront/Build/OpenedInputs.h"
#include "pointfront/Build/StoreBuilder.h"
#include "pointfront/Mosaic/KeptPoints.h"
#include "pointfront/Mosaic/TileBuild.h"
#include "pointfront/Points/PassChoice.h"

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pointfront
{

/// How often inputs are decoded.
enum class Decoding
{
  Automatic, ///< once where that is slow and the disk has room for the points
  Once, ///< surveys keep the points below FOLDER/work until the tiles are built
  Twice ///< for the survey and for the tiles
};

/// The wishes of who says `build --tiles`.
struct TilesRequest
{
  std::string folder;
  double edge = 0.0; ///< edge of a tile; 0: by the number of points
  /// Tiles that are done lie in its folder "tiles", and not in that of `folder`; empty: there.
  std::string published;
  bool force = false; ///< begin anew, or replace a collection that was changed since
  nlohmann::json settings; ///< the options that decide about the result
  BuildOptions options; ///< options of each tile; without its output
  bool automaticLayers = true;
  Decoding decoding = Decoding::Automatic;
  PassChoice passes;
  const PointFileOpener* formats = nullptr;
  /// Finds and opens all inputs, and warns of what is wrong with them.
  std::function<Result<OpenedInputs>()> openAll;
  std::function<void(const std::string&)> warn;
  ProgressFunction progress;
};

/// The outcome.
struct TilesReport
{
  BuildReport sums; ///< sums over all tiles
  std::uint64_t tiles = 0;
  std::uint64_t built = 0; ///< by this run
  std::string collection;
};

/// `build --tiles`: many inputs -> FOLDER/tiles/*.pfront and FOLDER/NAME.pfcollection, in steps
/// that each leave a file below FOLDER/work: a plan; a survey of each input; what all tiles have in
/// common; each tile; the collection. A step whose file says that it is done with the same inputs
/// and options is not done again. Steps that do not need one another may run in several processes.
/// Threads  one; it runs others.
class TilesBuild
{
public:
  explicit TilesBuild(TilesRequest request);

  /// All steps that are not done. Tiles that fail do not keep others from being built.
  Result<TilesReport> all();

  // One step. True: it was done; false: it had been.
  Result<bool> plan();
  Result<bool> survey(std::size_t input);
  Result<bool> settle();
  Result<bool> tile(const std::string& name);
  /// The collection, and what all steps came to.
  Result<TilesReport> collect();

private:
  struct Opened;
  // The inputs and their surveys.
  std::string work(const std::string& name) const { return request_.folder + "/work/" + name; }
  std::string surveyPath(std::size_t input) const;
  std::string tilePath(const TileIndex& tile) const;
  std::string storePath(const std::string& file) const;
  std::string keptPath(std::size_t input) const;
  Result<void> loadPlan();
  Result<void> loadTiles();
  Result<std::vector<PlannedInput>> plannedInputs(const PointSources& sources) const;
  Result<MosaicPlan> planned(PointSources sources, const std::vector<InputFault>& skipped) const;
  Result<double> chosenEdge(const PointSources& sources) const;
  std::string surveyKey(std::size_t input) const;
  bool surveyed(std::size_t input) const;
  std::vector<bool> keptInputs(const PointSources& sources) const;
  void tellNotKept(const Error& why, std::size_t input) const;
  std::shared_ptr<PointKeeper> keeperOf(std::size_t input, const PointSource& source) const;
  Result<SurveyRecord> readSurvey(std::size_t input, const ProgressFunction& progress) const;
  Result<void> surveyNow(std::size_t input, const ProgressFunction& progress) const;
  Result<void> addToTiles(std::size_t input, const SurveyRecord& record, MosaicTiles& tiles,
    std::vector<Error>& faults) const;
  // One tile.
  Result<std::vector<std::pair<std::size_t, SurveyRecord>>> surveysIn(const Bounds& box) const;
  Result<AttributePasses> passes() const;
  Result<TileInputs> inputsIn(const Bounds& box) const;
  double rim() const;
  Result<std::string> tileKey(const TileIndex& tile, double margin) const;
  std::optional<TileRecord> tileDone(const TileIndex& tile) const;
  Result<void> buildNow(const TileIndex& tile, const ProgressFunction& progress) const;
  // All of them.
  Result<void> surveyAll(TilesProgress& progress);
  Result<std::uint64_t> buildAll(TilesProgress& progress);
  std::string collectionPath() const;
  Result<void> writeCollection(const std::vector<TileRecord>& records);
  void removeOthers(const std::vector<TileRecord>& records) const;
  void tellWarnings(const std::vector<TileRecord>& records) const;

  TilesRequest request_;
  std::optional<MosaicPlan> plan_;
  std::optional<MosaicTiles> tiles_;
};

} // namespace pointfront
