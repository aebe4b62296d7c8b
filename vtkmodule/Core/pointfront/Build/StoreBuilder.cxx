#include "pointfront/Build/StoreBuilder.h"

#include "pointfront/Base/CpuClock.h"
#include "pointfront/Build/BuildStorage.h"
#include "pointfront/Build/TreeConstruction.h"
#include "pointfront/Export/OutputTarget.h"
#include "pointfront/Ingest/CommonRadii.h"
#include "pointfront/Ingest/CommonSchema.h"
#include "pointfront/Ingest/GridChoice.h"
#include "pointfront/Ingest/PointIngest.h"
#include "pointfront/Ingest/RecordColumns.h"
#include "pointfront/Ingest/ReferenceSystem.h"
#include "pointfront/Ingest/SampleRecords.h"
#include "pointfront/Ingest/StoredColours.h"
#include "pointfront/Points/EnclosingRadius.h"
#include "pointfront/Points/ObjectClass.h"
#include "pointfront/Points/SplatRadius.h"
#include "pointfront/Preview/PartialTrees.h"
#include "pointfront/Trees/MeanRecord.h"
#include "pointfront/Trees/TreeAssembly.h"

#include <algorithm>
#include <cmath>
#include <new>

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

Result<void> checkOptions(const Sources& sources, const BuildOptions& options)
{
  if (sources.empty())
  {
    return makeError(Error::Kind::BadArgument, "there is no input to build a store from");
  }
  if (options.nodePoints < 16 || options.nodePoints > (1u << 20))
  {
    return makeError(Error::Kind::BadArgument,
      "a node of " + std::to_string(options.nodePoints) +
        " points is not possible; choose 16 to 1048576 points a node");
  }
  if (options.structure == Structure::KdTree && options.refinement == Refinement::Replace)
  {
    return makeError(Error::Kind::BadArgument,
      "a kd-tree holds each point once and has no representatives: use refinement add, or an "
      "octree");
  }
  return checkOutputTarget(
    { options.outputPath, FileKind::Store, options.overwrite }, pathsOf(sources));
}

/// One build, from what is common to all sources to the committed store.
class StoreBuild
{
public:
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
  ClassLayers layers_;
  PoolPreparation prepared_;
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

/// Which column the class is, if there may be layers.
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
    classColumn_ = column;
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
  space_.shift = fittingShifts(axisShifts(space_.grid.scale), grid->low, grid->high);

  // A place that cannot be written is known before hours of reading.
  if (auto writable = StoreWriter::create(options_.outputPath, common_.schema); !writable)
  {
    return writable.error();
  }
  columns_ = guessColumns(sources_, common_, columnGuess());
  Result<void> ready = reserve();
  if (ready && !storage_.diskWarning.empty())
  {
    report_.warnings.push_back(storage_.diskWarning);
    crew_.tell(storage_.diskWarning); // what takes hours should not end with this
  }
  return ready;
}

ColumnGuess StoreBuild::columnGuess() const
{
  ColumnGuess guess;
  const auto colour = wideColourColumn(common_.schema);
  const bool deep = options_.colourDepth == ColourDepth::ByFile &&
    std::any_of(sources_.begin(), sources_.end(),
      [](const auto& source) { return source->description().deepColours; });
  guess.mayBeNarrow = options_.colourDepth != ColourDepth::Sixteen && !deep;
  for (std::size_t c = 0; c < common_.schema.size(); ++c)
  {
    // Means of equal values are these values, where sums are exact; not of normals.
    const bool mean = options_.refinement == Refinement::Replace && hasMean(common_.schema[c]) &&
      (common_.schema[c].type == ScalarType::Float64 || common_.schema[c].components > 1);
    const bool radius = common_.schema[c].name == enclosingRadiusName ||
      (options_.refinement == Refinement::Replace &&
        common_.schema[c].name == splatRadiusAttribute); // representatives have none
    guess.mayBeConstant.push_back(c != classColumn_ && c != colour && !mean && !radius);
  }
  return guess;
}

Result<void> StoreBuild::reserve()
{
  storage_ = {}; // the pool before gives its memory back first
  auto storage = reserveStorage(sources_, columns_.schema(), options_);
  if (!storage)
  {
    return storage.error();
  }
  storage_ = std::move(*storage);
  crew_.setThreads(storage_.plan.threads);
  return {};
}

Result<void> StoreBuild::readAll()
{
  std::uint64_t announced = 0;
  for (const auto& source : sources_)
  {
    announced += source->description().pointCount;
  }
  crew_.beginPhase("reading", announced, readShare);
  for (;;)
  {
    std::optional<std::size_t> classOffset;
    if (classColumn_)
    {
      classOffset = RecordLayout(columns_.schema()).offset(*columns_.place(*classColumn_));
    }
    const IngestSite site{ sources_, common_, columns_, space_, *storage_.pool,
      storage_.plan.blockPoints, countedCellsLog2(options_), crew_ };
    auto points = ingestPoints(site, classOffset);
    if (!points)
    {
      return points.error();
    }
    points->readSeconds += points_.readSeconds;
    points->quantiseSeconds += points_.quantiseSeconds;
    points_ = std::move(*points);
    if (!points_.guessedWrong && !narrowShifts())
    {
      return {};
    }
    if (points_.guessedWrong)
    {
      columns_ = columns_.carrying(common_.schema, points_.wrong);
    }
    if (Result<void> ready = reserve(); !ready)
    {
      return ready;
    }
    crew_.repeatPhase();
  }
}

/// True if the points reach farther than was declared and fit with other shifts: to be read again.
bool StoreBuild::narrowShifts()
{
  TreeSpace placed = space_;
  if (points_.kept == 0 || placeRoot(placed, points_.low, points_.high))
  {
    return false;
  }
  space_.shift = fittingShifts(space_.shift, points_.low, points_.high);
  return space_.shift != placed.shift;
}

/// Inputs that have points, none of which can be stored.
Result<void> StoreBuild::findEmptySources()
{
  std::vector<Error> faults;
  for (std::size_t s = 0; s < sources_.size(); ++s)
  {
    const SourceDescription& source = sources_[s]->description();
    const std::uint64_t before = s > 0 ? points_.sourceEnd[s - 1] : 0;
    if (source.pointCount == 0 || points_.sourceEnd[s] > before)
    {
      continue;
    }
    std::string why = "none of its " + std::to_string(source.pointCount) + " points can be stored";
    if (sources_.size() == 1)
    {
      why += ": " + rejectionText(report_);
    }
    faults.push_back(makeError(Error::Kind::BadFormat, source.path + ": " + why));
    report_.inputsSkipped.push_back({ source.path, why });
  }
  const bool stop = options_.onFault == OnFault::Stop || points_.kept == 0;
  return !faults.empty() && stop ? Result<void>(faultyInputs(faults, sources_.size()))
                                 : Result<void>();
}

Result<void> StoreBuild::read()
{
  if (Result<void> done = readAll(); !done)
  {
    return done;
  }
  report_.pointsRead = points_.read;
  report_.pointsRejected = points_.rejected;
  if (Result<void> some = findEmptySources(); !some)
  {
    return some;
  }
  if (!points_.rejected.empty())
  {
    report_.warnings.push_back(std::to_string(points_.read - points_.kept) + " of " +
      std::to_string(points_.read) + " points are left out: " + rejectionText(report_) + ".");
  }
  report_.phaseSeconds["read"] = points_.readSeconds;
  report_.phaseSeconds["quantise and count"] = points_.quantiseSeconds;
  report_.spilledBytes = storage_.pool->onDisk() ? points_.kept * storage_.pool->recordBytes() : 0;
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
  takeLayers();
  return {};
}

void StoreBuild::takeLayers()
{
  if (!classColumn_)
  {
    return;
  }
  std::vector<std::uint8_t> classes;
  for (const auto& [objectClass, table] : points_.counts.classes())
  {
    classes.push_back(objectClass);
  }
  const bool classified = !std::all_of(classes.begin(), classes.end(), unclassified);
  if (classified || options_.layering == Layering::ObjectClass)
  {
    const RecordLayout layout(columns_.schema());
    layers_ = ClassLayers(layout.offset(*columns_.place(*classColumn_)), std::move(classes));
  }
  else
  {
    points_.counts.merge();
  }
}

Error StoreBuild::tooLarge() const
{
  const Bounds bounds{ space_.grid.toWorld(points_.low), space_.grid.toWorld(points_.high) };
  const glm::dvec3 size = bounds.size();
  const double extent = std::max({ size.x, size.y, size.z });
  // The next power of ten that leaves a factor of two for axes of different scales.
  const double fitting = std::pow(10.0, std::ceil(std::log10(extent / 2.0e9)));
  char text[256];
  std::snprintf(text, sizeof(text),
    "the points extend over %.9g units, more than 32 bits of steps of %.9g units; a precision of "
    "%g "
    "fits, or leave out the points that lie far away",
    extent, std::min({ space_.grid.scale.x, space_.grid.scale.y, space_.grid.scale.z }), fitting);
  return makeError(Error::Kind::BadArgument, text);
}

Result<void> StoreBuild::cutIntoParts()
{
  crew_.beginPhase("sorting", points_.kept, sortShare);
  auto colours = storedColours(sources_, common_, columns_, points_, options_.colourDepth);
  if (!colours)
  {
    return colours.error();
  }
  stored_ = std::move(colours->schema);
  prepared_.widening = std::move(colours->widening);
  prepared_.points = points_.kept;
  prepared_.space = space_;
  prepared_.rootLog2 = rootLog2_;
  prepared_.layers = layers_;
  prepared_.findable = watch_ != nullptr;
  prepared_.blocks = std::move(points_.blocks);
  construction_ = treeConstruction(options_,
    { *storage_.pool, storage_.pool->recordBytes(), storage_.plan, crew_, columns_.schema() });
  Result<void> done = construction_->cut(prepared_, std::move(points_.counts), points_.hintedShift);
  report_.phaseSeconds["distribute"] = construction_->seconds();
  return done;
}

Result<void> StoreBuild::assemble()
{
  crew_.beginPhase("building", points_.kept, buildShare);
  auto writer = StoreWriter::create(options_.outputPath, stored_);
  if (!writer)
  {
    return writer.error();
  }
  const NodeEmitter emitter(space_, columns_, stored_, options_.refinement);
  AssemblyPlan plan = construction_->assembly(emitter);
  plan.readAhead = { storage_.plan.partsAhead, (storage_.plan.threads + 1) / 2 };
  const auto partial = partialTrees(emitter, plan.tree);
  TreeAssembly assembly(std::move(plan), **writer, crew_, partial.get());
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
    widened[s] = prepared_.widening && hasNarrowColours(sources_, points_, s);
  }
  const std::vector<std::byte> sample =
    sampleRecords(watch_->sample(), { common_, columns_, space_ }, prepared_.widening, widened);
  const PartialTreesSite site{ *construction_, emitter, storage_.pool->recordBytes(),
    description() };
  return std::make_unique<PartialTrees>(site, tree, sample, *watch_);
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
  description.splatRadiusBase =
    stored_.find(splatRadiusAttribute) ? commonSplatRadiusBase(sources_) : 0.0;
  for (const std::uint8_t objectClass : layers_.classes())
  {
    const std::string name = layers_.byClass() ? objectClassName(objectClass) : "all";
    description.layers.push_back({ objectClass, name, 0, 0 }); // the writer counts
  }
  return description;
}

Result<void> StoreBuild::commit(StoreWriter& writer, const Trees& trees)
{
  const NodeTable table = nodeTable(trees);
  StoreDescription description = this->description();
  description.levels = table.levels;
  description.pointCount = pointsIn(trees);
  if (Result<void> stop = crew_.outcome(); !stop)
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
  for (const auto step : { &StoreBuild::read, &StoreBuild::cutIntoParts, &StoreBuild::assemble })
  {
    if (Result<void> done = (this->*step)(); !done)
    {
      return withDemand(done.error(), storage_.disk);
    }
  }
  report_.seconds = crew_.secondsElapsed();
  report_.cpuSeconds = processSeconds() - cpuBefore;
  return std::move(report_);
}
} // namespace

std::string rejectionText(const BuildReport& report)
{
  std::string text;
  for (const auto& [reason, count] : report.pointsRejected)
  {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " " + reason;
  }
  return text;
}

Result<BuildReport> buildStore(const std::vector<std::unique_ptr<PointSource>>& sources,
  const BuildOptions& options, const ProgressFunction& progress, BuildWatch* watch)
{
  if (Result<void> done = checkOptions(sources, options); !done)
  {
    return done.error();
  }
  const CommonRadii radii = commonRadii(sources);
  const Sources& agreeing = radii.sources.empty() ? sources : radii.sources;
  Result<BuildReport> report = StoreBuild(agreeing, options, progress, watch).run();
  if (report)
  {
    append(report->warnings, radii.warnings);
  }
  return report;
}

} // namespace pointfront
