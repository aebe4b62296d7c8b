#include "pointfront/Build/StoreBuilder.h"

#include "pointfront/Base/CpuClock.h"
#include "pointfront/Base/NumberText.h"
#include "pointfront/Build/SampleRecords.h"
#include "pointfront/Build/StoreBuild.h"
#include "pointfront/Build/StoredColours.h"
#include "pointfront/Export/OutputTarget.h"
#include "pointfront/Ingest/CommonRadii.h"
#include "pointfront/Points/EnclosingRadius.h"
#include "pointfront/Points/ObjectClass.h"
#include "pointfront/Points/SplatRadius.h"
#include "pointfront/Store/StoreAssembly.h"

#include <algorithm>
#include <cmath>
#include <new>

namespace pointfront
{
namespace
{
// Shares of the whole, for the progress fraction; measured on LAS and LAZ. Reading has 0.35.
constexpr double sortShare = 0.1;
constexpr double buildShare = 0.55;

// Beside the tables lie nodes around which there is such a share of all points, and so many leaves'
// points: what a view of the whole cloud draws, and more than a request's worth.
constexpr std::uint64_t lateShare = 128;
constexpr std::uint64_t lateLeaves = 4;

Result<void> checkOptions(const StoreBuild::Sources& sources, const BuildOptions& options)
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
  return checkOutputTarget(
    { options.outputPath, FileKind::Store, options.overwrite }, pathsOf(sources));
}

std::uint64_t pointsIn(const StoreBuild::Trees& trees)
{
  std::uint64_t points = 0;
  for (const auto& root : trees)
  {
    points += root->row.pointsBelow;
  }
  return points;
}
} // namespace

Error StoreBuild::tooLarge() const
{
  const Bounds bounds{ space_.grid.toWorld(points_.low), space_.grid.toWorld(points_.high) };
  const glm::dvec3 size = bounds.size();
  const double extent = std::max({ size.x, size.y, size.z });
  // The next power of ten that leaves a factor of two for axes of different scales.
  const double fitting = std::pow(10.0, std::ceil(std::log10(extent / 2.0e9)));
  const double step = std::min({ space_.grid.scale.x, space_.grid.scale.y, space_.grid.scale.z });
  return makeError(Error::Kind::BadArgument,
    "the points extend over " + numberText(extent, 9) + " units, more than 32 bits of steps of " +
      numberText(step, 9) + " units; a precision of " + numberText(fitting, 6) +
      " fits, or leave out the points that lie far away");
}

Result<void> StoreBuild::cutIntoParts()
{
  crew_.beginPhase("sorting", points_.kept, sortShare);
  auto colours =
    storedColours(sources_, common_, columns_, points_, options_.colourDepth, options_.wideColours);
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
  auto writer = assembleStore(std::move(output_), stored_);
  if (!writer)
  {
    return writer.error();
  }
  const NodeEmitter emitter(space_, columns_, stored_, options_.refinement);
  AssemblyPlan plan = construction_->assembly(emitter);
  plan.lateFrom = std::max(points_.kept / lateShare, lateLeaves * options_.nodePoints);
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
      return withEstimate(done.error(), storage_.disk);
    }
  }
  if (missing_ > 0)
  {
    report_.pointsRejected["missing"] = missing_;
  }
  report_.seconds = crew_.secondsElapsed();
  report_.cpuSeconds = processSeconds() - cpuBefore;
  return std::move(report_);
}

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
  const StoreBuild::Sources& agreeing = radii.sources.empty() ? sources : radii.sources;
  Result<BuildReport> report = StoreBuild(agreeing, options, progress, watch).run();
  if (report)
  {
    report->warnings.insert(report->warnings.end(), radii.warnings.begin(), radii.warnings.end());
  }
  return report;
}

} // namespace pointfront
