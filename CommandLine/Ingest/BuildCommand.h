#pragma once

#include "BuildPasses.h"
#include "Command.h"
#include "SourceChoice.h"
#include "TilesBuild.h"

#include "pointfront/Build/StoreBuilder.h"
#include "pointfront/Points/PointSource.h"
#include "pointfront/Preview/BuildRun.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// `pointfront build`: point files -> one store, or a collection of tiles.
class BuildCommand final : public Command
{
public:
  void declare(CLI::App& program) override;
  Result<void> run() override;

private:
  void declareTiles();
  Result<void> buildTiles();
  /// The options that decide about the bytes of tiles, as they were given.
  nlohmann::json tileSettings() const;
  Result<void> runAll(TilesBuild& build);
  /// One step of --only, and what it prints.
  Result<void> runStep(TilesBuild& build);
  Result<void> tell(const TilesReport& report) const;
  void tell(const BuildReport& report) const;
  /// From the words of the command line to options_.
  Result<void> takeOptions();
  /// Opens every input, but for those to skip; warns of what was wrong and survived.
  Result<OpenedInputs> openSources() const;
  /// Passes, preview and build, with progress on stderr. `sources` becomes what the passes gave.
  Result<BuildReport> buildFrom(PointSources& sources, const AttributePasses& passes);
  /// Tells what the build itself found; what the sources said has been told, with their paths.
  void warnOfBuild(const PointSources& sources, const BuildReport& report) const;

  std::vector<std::string> inputs_;
  BuildOptions options_;
  SourceChoice sourceChoice_;
  BuildPasses passes_;
  std::string attributes_ = "all";
  std::string progress_ = "auto";
  std::string preview_ = "auto";
  std::string structure_ = "octree";
  std::string refinement_ = "add";
  std::string layers_; ///< empty: by class if any point is classified
  double precision_ = 0.0;
  std::optional<Bounds> box_;
  bool json_ = false;
  bool tiles_ = false;
  std::string tileEdge_ = "auto";
  std::string only_; ///< a step of a build of tiles; empty: all
  std::string published_; ///< address that tiles were copied to
  std::string decode_ = "auto"; ///< once, twice
};

/// The keys of `build --json`; with `skips` also those of inputs that were left out, with `boxed`
/// that of points outside of the box.
std::string buildReportJson(
  const BuildReport& report, std::uint64_t peakBytes, bool skips, bool boxed = false);

} // namespace pointfront
