#include "pointfront/Build/StoreBuild.h"

#include "pointfront/Ingest/GridChoice.h"
#include "pointfront/Means/MeanRecord.h"
#include "pointfront/Points/EnclosingRadius.h"
#include "pointfront/Points/ObjectClass.h"
#include "pointfront/Points/SplatRadius.h"
#include "pointfront/Query/InputBox.h"
#include "pointfront/Store/StoreAssembly.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pointfront
{
namespace
{
/// Share of the whole, for the progress fraction; measured on LAS and LAZ.
constexpr double readShare = 0.35;

void append(std::vector<std::string>& all, const std::vector<std::string>& more)
{
  all.insert(all.end(), more.begin(), more.end());
}
} // namespace

/// Which column the class is, if there may be layers.
Result<void> StoreBuild::chooseLayers()
{
  const auto column = common_.schema.find("classification");
  const bool usable = column && common_.schema[*column].bytes() == 1;
  if (!usable && options_.layering == Layering::ObjectClass)
  {
    return makeError(Error::Kind::BadArgument,
      column ? "layers by class need a 'classification' of one byte (0 to 255), and this one is " +
          std::string(nameOf(common_.schema[*column].type)) +
          "; build without layers, or with classes that a byte holds"
             : "layers by class need the attribute 'classification', which is not among those to "
               "store; build without layers, or name it among the attributes");
  }
  if (column && !usable)
  {
    report_.warnings.push_back("'classification' is " +
      std::string(nameOf(common_.schema[*column].type)) +
      ": classes are of one byte (0 to 255), so it is an attribute like any other, and no points "
      "are chosen by class.");
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
  if (Result<void> whole = findShortSources(); !whole)
  {
    return whole;
  }
  for (const auto& source : sources_)
  {
    append(report_.warnings, source->description().warnings);
  }
  auto reference = commonReferenceSystem(sources_);
  // Where others decided the grid, sources without points stand for some of another tile.
  const SchemaOf from = options_.grid ? SchemaOf::AllSources : SchemaOf::SourcesWithPoints;
  auto schema = commonSchema(sources_, options_.attributes, from);
  auto grid =
    options_.grid ? givenGrid(sources_, *options_.grid) : chooseGrid(sources_, options_.precision);
  if (!reference || !schema || !grid)
  {
    return !reference ? reference.error() : !schema ? schema.error() : grid.error();
  }
  reference_ = std::move(*reference);
  common_ = std::move(*schema);
  append(report_.warnings, std::exchange(reference_.warnings, {}));
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

  // A place that cannot be written is known before hours of reading, and is ours from here on.
  if (Result<void> possible = checkColumnCount(common_.schema); !possible)
  {
    return possible;
  }
  auto output = OutputFile::create(options_.outputPath);
  if (!output)
  {
    return output.error();
  }
  output_ = std::move(*output);
  columns_ = guessColumns(sources_, common_, columnGuess());
  Result<void> ready = reserve();
  if (ready && !storage_.diskWarning.empty())
  {
    report_.warnings.push_back(storage_.diskWarning);
    crew_.tell(storage_.diskWarning); // a full disk should not end work of hours
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
  guess.mayBeNarrow =
    options_.colourDepth != ColourDepth::Sixteen && !deep && !options_.wideColours;
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

/// Inputs whose header promises more points than there are.
Result<void> StoreBuild::findShortSources()
{
  std::vector<Error> faults;
  for (const auto& input : sources_)
  {
    const SourceDescription& source = input->description();
    const std::uint64_t promised = source.headerPointCount.value_or(source.pointCount);
    if (promised > source.pointCount)
    {
      missing_ += promised - source.pointCount;
      faults.push_back(makeError(Error::Kind::Truncated,
        source.path + ": " + std::to_string(promised - source.pointCount) + " of the " +
          std::to_string(promised) +
          " points that its header promises are missing; get a whole copy"));
    }
  }
  return !faults.empty() && options_.wholeInputs
    ? Result<void>(faultyInputs(faults, sources_.size()))
    : Result<void>();
}

/// Whether points of that input are stored.
bool StoreBuild::givesPoints(std::size_t source) const
{
  return points_.sourceEnd[source] > (source > 0 ? points_.sourceEnd[source - 1] : 0);
}

/// Inputs that have points, none of which can be stored.
Result<void> StoreBuild::findEmptySources()
{
  if (options_.box) // points that are not stored lie outside
  {
    report_.pointsOutside = options_.box->pointsOutside();
    return points_.kept > 0 ? Result<void>() : options_.box->nothingInside();
  }
  std::vector<Error> faults;
  for (std::size_t s = 0; s < sources_.size(); ++s)
  {
    const SourceDescription& source = sources_[s]->description();
    if (source.pointCount == 0 || givesPoints(s))
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
  reference_.keepTimes(sources_, [this](std::size_t source) { return givesPoints(source); });
  append(report_.warnings, std::exchange(reference_.warnings, {}));
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

} // namespace pointfront
