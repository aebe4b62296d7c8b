#pragma once

#include "pointfront/Build/BuildStorage.h"
#include "pointfront/Build/PartialTrees.h"
#include "pointfront/Build/StoreBuilder.h"
#include "pointfront/Build/TreeConstruction.h"
#include "pointfront/Disk/OutputFile.h"
#include "pointfront/Ingest/CommonSchema.h"
#include "pointfront/Ingest/PointIngest.h"
#include "pointfront/Ingest/RecordColumns.h"
#include "pointfront/Ingest/ReferenceSystem.h"
#include "pointfront/Trees/TreeAssembly.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// One build, from what is common to all sources to the committed store.
class StoreBuild
{
public:
  using Sources = std::vector<std::unique_ptr<PointSource>>;
  using Trees = std::vector<std::unique_ptr<BuiltNode>>; ///< the tree of each layer

  StoreBuild(const Sources& sources, const BuildOptions& options, ProgressFunction progress,
    BuildWatch* watch)
    : sources_(sources)
    , options_(options)
    , watch_(watch)
    , crew_(std::move(progress))
  {
  }
  Result<BuildReport> run();

private:
  Result<void> prepare();
  Result<void> addRadius();
  Result<void> chooseLayers();
  ColumnGuess columnGuess() const;
  Result<void> reserve();
  Result<void> read();
  Result<void> readAll();
  bool narrowShifts();
  Result<void> findEmptySources();
  bool givesPoints(std::size_t source) const;
  Result<void> findShortSources();
  void takeLayers();
  Result<void> cutIntoParts();
  Result<void> assemble();
  Error tooLarge() const;
  std::unique_ptr<PartialTrees> partialTrees(
    const NodeEmitter& emitter, const std::vector<PartNode>& tree) const;
  StoreDescription description() const;
  Result<void> commit(StoreWriter& writer, const Trees& trees);
  Result<void> checkCounts(const Trees& trees) const;

  const Sources& sources_;
  const BuildOptions& options_;
  BuildWatch* watch_;
  BuildReport report_;
  CommonSchema common_;
  ReferenceSystem reference_;
  TreeSpace space_;
  unsigned rootLog2_ = 0;
  std::optional<std::size_t> classColumn_; ///< common, by which layers are told apart
  RecordColumns columns_;
  BuildStorage storage_;
  WorkCrew crew_;
  IngestedPoints points_;
  std::unique_ptr<OutputFile> output_; ///< until assemble()
  std::uint64_t missing_ = 0; ///< points that headers promise and files lack
  ClassLayers layers_;
  PoolPreparation prepared_;
  std::unique_ptr<TreeConstruction> construction_;
  AttributeSchema stored_;
};

} // namespace pointfront
