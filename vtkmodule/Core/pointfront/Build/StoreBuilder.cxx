#include "pointfront/Build/StoreBuilder.h"

#include "pointfront/Build/CommonSchema.h"
#include "pointfront/Build/CpuClock.h"
#include "pointfront/Build/DiskDemand.h"
#include "pointfront/Build/GridChoice.h"
#include "pointfront/Build/MemoryPlan.h"
#include "pointfront/Build/PartialTrees.h"
#include "pointfront/Build/PointIngest.h"
#include "pointfront/Build/ReferenceSystem.h"
#include "pointfront/Build/SampleRecords.h"
#include "pointfront/Build/TreeAssembly.h"
#include "pointfront/Build/TreeConstruction.h"
#include "pointfront/Points/EnclosingRadius.h"
#include "pointfront/Points/ObjectClass.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <new>
#include <thread>
#include <unistd.h>

namespace pointfront
{
namespace
{
using Sources = std::vector<std::unique_ptr<PointSource>>;
using Trees = std::vector<std::unique_ptr<BuiltNode>>; // of each layer

// Shares of the whole, for the progress fraction; measured on LAS and LAZ.
constexpr double readShare = 0.35;
constexpr double sortShare = 0.1;
constexpr double buildShare = 0.55;

std::uint64_t machineMemory()
{
  return std::uint64_t(sysconf(_SC_PHYS_PAGES)) * std::uint64_t(sysconf(_SC_PAGESIZE));
}

std::string folderOf(const std::string& path)
{
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return folder.empty() ? "." : folder;
}

Result<void> checkOptions(const Sources& sources, const BuildOptions& options)
{
  if (sources.empty())
  {
    return makeError(Error::Kind::BadArgument, "there is no input to build a store from");
  }
  if (options.nodePoints < 16 || options.nodePoints > (1u << 20))
  {
    return makeError(
      Error::Kind::BadArgument, "a node of " + std::to_string(options.nodePoints) +
                                  " points is not possible; choose 16 to 1048576 points a node");
  }
  if (options.structure == Structure::KdTree && options.refinement == Refinement::Replace)
  {
    return makeError(Error::Kind::BadArgument,
      "a kd-tree holds each point once and has no representatives: use refinement add, or an "
      "octree");
  }
  std::error_code ignored;
  if (!options.overwrite && std::filesystem::exists(options.outputPath, ignored))
  {
    return makeError(Error::Kind::Unwritable,
      "'" + options.outputPath + "' exists already; allow overwriting or choose another name");
  }
  return {};
}

MemoryDemand demandOf(
  const Sources& sources, const AttributeSchema& schema, const BuildOptions& options)
{
  MemoryDemand demand;
  for (const auto& source : sources)
  {
    for (std::uint64_t chunk = 0; chunk < source->chunkCount(); ++chunk)
    {
      demand.points += source->chunkPoints(chunk);
      demand.largestChunk = std::max(demand.largestChunk, source->chunkPoints(chunk));
    }
    demand.sourceBytes = std::max(demand.sourceBytes, source->description().schema.pointBytes());
  }
  demand.recordBytes = RecordLayout(schema).bytes();
  demand.partBytes = constructionBytes(options, schema);
  demand.wholePart = constructionPart(options);
  demand.nodePoints = options.nodePoints;
  demand.threads =
    options.threads > 0 ? options.threads : std::max(1u, std::thread::hardware_concurrency());
  demand.memoryBytes = options.memoryBytes > 0 ? options.memoryBytes : machineMemory() / 2;
  return demand;
}

/// One build, from what is common to all sources to the committed store.
class StoreBuild
{
public:
  StoreBuild(const Sources& sources, const BuildOptions& options, ProgressFunction progress,
    BuildWatch* watch)
      : sources_(sources), options_(options), progress_(std::move(progress)), watch_(watch)
  {
  }
  Result<BuildReport> run();

private:
  Result<void> prepare();
  Result<void> addRadius();
  Result<void> chooseLayers();
  Result<void> read();
  Result<void> cutIntoParts();
  Result<void> assemble();
  Error tooLarge() const;
  Result<void> checkColourDepth() const;
  bool narrowColours(std::size_t source) const;
  AttributeSchema storedSchema(std::optional<ColourWidening>& widening) const;
  std::unique_ptr<PartialTrees> partialTrees(
    const NodeEmitter& emitter, const std::vector<PartNode>& tree) const;
  StoreDescription description() const;
  Result<void> commit(StoreWriter& writer, const Trees& trees);
  Result<void> checkCounts(const Trees& trees) const;

  const Sources& sources_;
  const BuildOptions& options_;
  ProgressFunction progress_;
  BuildWatch* watch_;
  BuildReport report_;
  CommonSchema common_;
  ReferenceSystem reference_;
  TreeSpace space_;
  unsigned rootLog2_ = 0;
  MemoryPlan plan_;
  std::size_t recordBytes_ = 0;
  DiskDemand disk_;
  std::unique_ptr<WorkCrew> crew_;
  std::unique_ptr<RecordPool> pool_;
  IngestedPoints points_;
  std::optional<std::size_t> classOffset_; ///< by which layers are told apart, in a record
  ClassLayers layers_;
  std::optional<ColourWidening> widening_;
  std::unique_ptr<TreeConstruction> construction_;
  AttributeSchema stored_;
};

std::uint64_t pointsIn(const Trees& trees)
{
  std::uint64_t points = 0;
  for (const auto& root : trees)
  {
    points += root->row.pointsBelow;
  }
  return points;
}

void append(std::vector<std::string>& all, const std::vector<std::string>& more)
{
  all.insert(all.end(), more.begin(), more.end());
}

/// Where the class is in a record, if there may be layers.
Result<void> StoreBuild::chooseLayers()
{
  const auto column = common_.schema.find("classification");
  const bool usable = column && common_.schema[*column].bytes() == 1;
  if (!usable && options_.layering == Layering::ObjectClass)
  {
    return makeError(Error::Kind::BadArgument,
      "layers by class need the attribute 'classification' of one byte, which is not among those "
      "to store; build without layers, or name it among the attributes");
  }
  if (usable && options_.layering != Layering::None)
  {
    classOffset_ = RecordLayout(common_.schema).offset(*column);
  }
  return {};
}

/// Points of the input have radius 0: no source has the column, so all get zeros.
Result<void> StoreBuild::addRadius()
{
  if (options_.refinement == Refinement::Add)
  {
    return {};
  }
  if (!common_.schema.add(enclosingRadiusAttribute()))
  {
    return makeError(Error::Kind::BadArgument,
      std::string("the input has an attribute '") + enclosingRadiusName +
        "' already, which representatives need; leave it out of the attributes to store");
  }
  for (std::vector<ColumnMapping>& mapping : common_.mappings)
  {
    mapping.emplace_back();
  }
  return {};
}

Result<void> StoreBuild::prepare()
{
  for (const auto& source : sources_)
  {
    append(report_.warnings, source->description().warnings);
  }
  auto reference = commonReferenceSystem(sources_);
  auto schema = commonSchema(sources_, options_.attributes);
  auto grid = chooseGrid(sources_, options_.precision);
  if (!reference || !schema || !grid)
  {
    return !reference ? reference.error() : !schema ? schema.error() : grid.error();
  }
  reference_ = std::move(*reference);
  common_ = std::move(*schema);
  append(report_.warnings, reference_.warnings);
  append(report_.warnings, common_.warnings);
  append(report_.warnings, grid->warnings);
  if (Result<void> ready = addRadius(); !ready)
  {
    return ready;
  }
  if (Result<void> ready = chooseLayers(); !ready)
  {
    return ready;
  }
  space_.grid = grid->grid;
  space_.shift = axisShifts(space_.grid.scale);

  const MemoryDemand demand = demandOf(sources_, common_.schema, options_);
  auto plan = planMemory(demand);
  if (!plan)
  {
    return plan.error();
  }
  plan_ = *plan;
  recordBytes_ = demand.recordBytes;
  crew_ = std::make_unique<WorkCrew>(plan_.threads, progress_);
  // A place that cannot be written is known before hours of reading.
  if (auto writable = StoreWriter::create(options_.outputPath, common_.schema); !writable)
  {
    return writable.error();
  }
  disk_.outputFolder = folderOf(options_.outputPath);
  disk_.storeBytes = leastStoreBytes(demand.points, recordBytes_);
  disk_.spillFolder =
    options_.temporaryFolder.empty() ? disk_.outputFolder : options_.temporaryFolder;
  disk_.spillBytes = plan_.spill ? demand.points * recordBytes_ : 0;
  if (Result<void> enough = checkDiskSpace(disk_); !enough)
  {
    return enough;
  }
  if (!plan_.spill)
  {
    pool_ = RecordPool::inMemory(demand.points, recordBytes_);
    return {};
  }
  auto spilled = RecordPool::spilled(disk_.spillFolder, demand.points, recordBytes_);
  if (!spilled)
  {
    return spilled.error();
  }
  pool_ = std::move(*spilled);
  return {};
}

Result<void> StoreBuild::read()
{
  std::uint64_t announced = 0;
  for (const auto& source : sources_)
  {
    announced += source->description().pointCount;
  }
  crew_->beginPhase("reading", announced, readShare);
  auto points = ingestPoints(sources_, common_, space_, *pool_, *crew_, classOffset_);
  if (!points)
  {
    return points.error();
  }
  points_ = std::move(*points);
  report_.pointsRead = points_.read;
  report_.pointsRejected = points_.rejected;
  report_.phaseSeconds["read"] = points_.readSeconds;
  report_.phaseSeconds["quantise and count"] = points_.quantiseSeconds;
  report_.spilledBytes = pool_->onDisk() ? points_.kept * recordBytes_ : 0;
  if (points_.kept == 0)
  {
    report_.warnings.push_back("The input has no points to store; the store is empty.");
    return {};
  }
  const auto rootLog2 = placeRoot(space_, points_.low, points_.high);
  if (!rootLog2)
  {
    return tooLarge();
  }
  rootLog2_ = *rootLog2;
  if (classOffset_)
  {
    std::vector<std::uint8_t> classes;
    for (const auto& [objectClass, table] : points_.counts.classes())
    {
      classes.push_back(objectClass);
    }
    const bool classified = !std::all_of(classes.begin(), classes.end(), unclassified);
    if (classified || options_.layering == Layering::ObjectClass)
    {
      layers_ = ClassLayers(*classOffset_, std::move(classes));
    }
    else
    {
      points_.counts.merge();
    }
  }
  return {};
}

Error StoreBuild::tooLarge() const
{
  const Bounds bounds{space_.grid.toWorld(points_.low), space_.grid.toWorld(points_.high)};
  const glm::dvec3 size = bounds.size();
  const double extent = std::max({size.x, size.y, size.z});
  // The next power of ten that leaves a factor of two for axes of different scales.
  const double fitting = std::pow(10.0, std::ceil(std::log10(extent / 2.0e9)));
  char text[256];
  std::snprintf(text, sizeof(text),
    "the points extend over %.9g units, more than 32 bits of steps of %.9g units; a precision of "
    "%g "
    "fits, or leave out the points that lie far away",
    extent, std::min({space_.grid.scale.x, space_.grid.scale.y, space_.grid.scale.z}), fitting);
  return makeError(Error::Kind::BadArgument, text);
}

Result<void> StoreBuild::checkColourDepth() const
{
  for (std::size_t s = 0; s < sources_.size(); ++s)
  {
    if (options_.colourDepth == ColourDepth::Eight && points_.largestColour[s] > 255)
    {
      return makeError(Error::Kind::BadArgument,
        "'" + sources_[s]->description().path + "' has a colour of " +
          std::to_string(points_.largestColour[s]) +
          ", which is more than 8 bits hold; let the colour depth be 16, or found by file");
    }
  }
  return {};
}

/// A file whose 16-bit colours hold 8 bits.
bool StoreBuild::narrowColours(std::size_t source) const
{
  return points_.largestColour[source] > 0 && points_.largestColour[source] <= 255;
}

/// 16-bit colours become 8-bit if all fit; if only those of some files do, these are widened.
AttributeSchema StoreBuild::storedSchema(std::optional<ColourWidening>& widening) const
{
  const auto column = wideColourColumn(common_.schema);
  const auto& largest = points_.largestColour;
  if (!column || options_.colourDepth == ColourDepth::Sixteen)
  {
    return common_.schema;
  }
  if (*std::max_element(largest.begin(), largest.end()) <= 255)
  {
    AttributeSchema narrow;
    for (std::size_t c = 0; c < common_.schema.size(); ++c)
    {
      Attribute attribute = common_.schema[c];
      attribute.type = c == *column ? ScalarType::UInt8 : attribute.type;
      narrow.add(std::move(attribute));
    }
    return narrow;
  }
  widening.emplace();
  widening->offset = RecordLayout(common_.schema).offset(*column);
  widening->components = common_.schema[*column].components;
  std::uint64_t begin = 0;
  for (std::size_t s = 0; s < sources_.size(); ++s)
  {
    if (narrowColours(s))
    {
      widening->runs.push_back({begin, points_.sourceEnd[s] - begin});
    }
    begin = points_.sourceEnd[s];
  }
  return common_.schema;
}

Result<void> StoreBuild::cutIntoParts()
{
  crew_->beginPhase("sorting", points_.kept, sortShare);
  if (Result<void> fits = checkColourDepth(); !fits)
  {
    return fits;
  }
  PoolPreparation preparation;
  preparation.points = points_.kept;
  preparation.space = space_;
  preparation.rootLog2 = rootLog2_;
  preparation.layers = layers_;
  stored_ = storedSchema(widening_);
  preparation.widening = widening_;
  preparation.findable = watch_ != nullptr;
  construction_ = treeConstruction(options_, {*pool_, recordBytes_, plan_, *crew_, common_.schema});
  Result<void> done =
    construction_->cut(preparation, std::move(points_.counts), points_.hintedShift);
  report_.phaseSeconds["distribute"] = construction_->seconds();
  return done;
}

Result<void> StoreBuild::assemble()
{
  crew_->beginPhase("building", points_.kept, buildShare);
  auto writer = StoreWriter::create(options_.outputPath, stored_);
  if (!writer)
  {
    return writer.error();
  }
  const NodeEmitter emitter(space_, common_.schema, stored_, options_.refinement);
  AssemblyPlan plan = construction_->assembly(emitter);
  const auto partial = partialTrees(emitter, plan.tree);
  TreeAssembly assembly(std::move(plan), **writer, *crew_, partial.get());
  auto trees = assembly.run();
  report_.phaseSeconds["load"] = assembly.loadSeconds();
  report_.phaseSeconds["sort"] = assembly.seconds().sort;
  report_.phaseSeconds["sample"] = assembly.seconds().sample;
  report_.phaseSeconds["encode"] = assembly.seconds().encode;
  report_.phaseSeconds["write"] = assembly.writeSeconds();
  if (!trees)
  {
    return trees.error();
  }
  if (Result<void> done = checkCounts(*trees); !done)
  {
    return done;
  }
  return commit(**writer, *trees);
}

/// The trees as the watch sees them, with its sample as records of the pool; nothing without a
/// watch, or without memory for it.
std::unique_ptr<PartialTrees> StoreBuild::partialTrees(
  const NodeEmitter& emitter, const std::vector<PartNode>& tree) const
try
{
  if (!watch_)
  {
    return nullptr;
  }
  std::vector<bool> widened(sources_.size(), false);
  for (std::size_t s = 0; s < sources_.size(); ++s)
  {
    widened[s] = widening_ && narrowColours(s);
  }
  const std::vector<std::byte> sample =
    sampleRecords(watch_->sample(), common_, space_, widening_, widened);
  return std::make_unique<PartialTrees>(
    PartialTreesSite{*construction_, emitter, recordBytes_, description()}, tree, sample, *watch_);
}
catch (const std::bad_alloc&)
{
  return nullptr;
}

Result<void> StoreBuild::checkCounts(const Trees& trees) const
{
  const std::uint64_t stored = pointsIn(trees);
  std::uint64_t rejected = 0;
  for (const auto& [reason, count] : report_.pointsRejected)
  {
    rejected += count;
  }
  if (points_.read != stored + rejected)
  {
    return makeError(Error::Kind::Corrupt,
      "internal: of " + std::to_string(points_.read) + " points read, " + std::to_string(stored) +
        " were stored and " + std::to_string(rejected) +
        " rejected; the store was not written, please report this");
  }
  return {};
}

/// All that is known before the trees are.
StoreDescription StoreBuild::description() const
{
  StoreDescription description;
  description.grid = space_.grid;
  description.crsWkt = reference_.wkt;
  description.structure = options_.structure == Structure::KdTree ? "kdtree" : "octree";
  description.refinement = options_.refinement;
  description.schema = stored_;
  description.metadata = reference_.metadata;
  description.generator = "pointfront " POINTFRONT_VERSION;
  for (const std::uint8_t objectClass : layers_.classes())
  {
    const std::string name = layers_.byClass() ? objectClassName(objectClass) : "all";
    description.layers.push_back({objectClass, name, 0, 0}); // the writer counts
  }
  return description;
}

Result<void> StoreBuild::commit(StoreWriter& writer, const Trees& trees)
{
  const NodeTable table = nodeTable(trees);
  StoreDescription description = this->description();
  description.levels = table.levels;
  description.pointCount = pointsIn(trees);
  if (Result<void> stop = crew_->outcome(); !stop)
  {
    return stop; // cancelled after the last point, before the store is there
  }
  if (Result<void> done = writer.commit(description, table.nodes, table.roots, table.payloads);
      !done)
  {
    return done;
  }
  report_.nodes = table.nodes.size();
  report_.pointsStored = description.pointCount;
  report_.bytesWritten = writer.bytesWritten();
  return {};
}

Result<BuildReport> StoreBuild::run()
{
  const double cpuBefore = processSeconds();
  if (Result<void> ready = prepare(); !ready)
  {
    return ready.error();
  }
  for (const auto step : {&StoreBuild::read, &StoreBuild::cutIntoParts, &StoreBuild::assemble})
  {
    if (Result<void> done = (this->*step)(); !done)
    {
      return withDemand(done.error(), disk_);
    }
  }
  report_.seconds = crew_->secondsElapsed();
  report_.cpuSeconds = processSeconds() - cpuBefore;
  return std::move(report_);
}
} // namespace

Result<BuildReport> buildOctreeStore(const std::vector<std::unique_ptr<PointSource>>& sources,
  const BuildOptions& options, const ProgressFunction& progress, BuildWatch* watch)
{
  if (Result<void> done = checkOptions(sources, options); !done)
  {
    return done.error();
  }
  return StoreBuild(sources, options, progress, watch).run();
}

} // namespace pointfront
