#include "MapperStyle.h"

#include "MapperProperties.h"
#include "pointfront/Points/AttributeNames.h"
#include "pointfront/Style/ClassHeights.h"
#include "pointfront/Style/FilterPruning.h"

#include <vtkActor.h>
#include <vtkColorTransferFunction.h>
#include <vtkDoubleArray.h>
#include <vtkLookupTable.h>
#include <vtkMath.h>
#include <vtkNew.h>
#include <vtkPolyDataMapper.h>
#include <vtkProperty.h>
#include <vtkScalarsToColors.h>
#include <vtkSmartPointer.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace pointfront
{
namespace
{

/// Entries of a continuous function: finer than 8-bit colours tell apart, within every GL's limit.
constexpr int continuousEntries = 8192;

/// The colours of some values; L, LA, RGB or RGBA, as the table's maker chose.
std::vector<Rgba8> coloursOf(vtkScalarsToColors& table, const std::vector<double>& values)
{
  vtkNew<vtkDoubleArray> array;
  array->SetNumberOfValues(static_cast<vtkIdType>(values.size()));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  // As vtkMapper: the property's opacity counts, not the table's.
  const double alphaOfTable = table.GetAlpha();
  table.SetAlpha(1.0);
  const auto mapped = vtkSmartPointer<vtkUnsignedCharArray>::Take(
    table.MapScalars(array, VTK_COLOR_MODE_MAP_SCALARS, 0));
  table.SetAlpha(alphaOfTable);
  const unsigned char* colour = mapped->GetPointer(0);
  const int components = mapped->GetNumberOfComponents();
  const bool grey = components < 3;
  std::vector<Rgba8> colours;
  for (std::size_t i = 0; i < values.size(); ++i, colour += components)
  {
    const unsigned char alpha = components == 4 ? colour[3] : (components == 2 ? colour[1] : 255);
    colours.push_back({ colour[0], colour[grey ? 0 : 1], colour[grey ? 0 : 2], alpha });
  }
  return colours;
}

/// `values`: one below the range, one in the middle of each entry, one above.
ColourMap filled(ColourMap map, vtkScalarsToColors& table, std::vector<double> values)
{
  values.push_back(vtkMath::Nan());
  const std::vector<Rgba8> colours = coloursOf(table, values);
  map.below = colours.front();
  map.above = colours[colours.size() - 2];
  map.missing = colours.back();
  map.usesBelow = map.usesAbove = true;
  map.entries.assign(colours.begin() + 1, colours.end() - 2);
  return map;
}

ColourMap sampleIntegers(vtkScalarsToColors& table, const std::array<std::int64_t, 2>& integers)
{
  ColourMap map;
  map.indexed = true;
  map.range = { static_cast<double>(integers[0]), static_cast<double>(integers[1]) };
  // VTK makes black of what has no logarithm. Values of other types are below the range then.
  const bool decades = table.UsingLogScale() != 0 && table.GetRange()[0] > 0.0;
  const double below = table.GetRange()[0] / 2.0;
  std::vector<double> values;
  for (std::int64_t value = integers[0] - 1; value <= integers[1] + 1; ++value)
  {
    values.push_back(decades && value <= 0 ? below : static_cast<double>(value));
  }
  return filled(std::move(map), table, std::move(values));
}

/// A range of one value: what lies above it has the last colour.
ColourMap sampleStep(vtkScalarsToColors& table, double value)
{
  const double width = 1e-7 * std::max(1.0, std::abs(value));
  ColourMap map;
  map.range = { value, value + 2.0 * width };
  return filled(std::move(map), table, { value - width, value, value + width, value + width });
}

ColourMap sampleRange(vtkScalarsToColors& table)
{
  ColourMap map;
  map.range = { table.GetRange()[0], table.GetRange()[1] };
  if (map.range[0] == map.range[1])
  {
    return sampleStep(table, map.range[0]);
  }
  map.logarithmic = table.UsingLogScale() != 0 && map.range[0] > 0.0 && map.range[1] > 0.0;
  const double low = map.logarithmic ? std::log10(map.range[0]) : map.range[0];
  const double high = map.logarithmic ? std::log10(map.range[1]) : map.range[1];
  const vtkIdType available = table.GetNumberOfAvailableColors();
  const bool uneven = table.UsingLogScale() != 0 && !map.logarithmic;
  const int size = !uneven && available > 0 && available <= continuousEntries
    ? static_cast<int>(available)
    : continuousEntries;
  const double halfWidth = high / 2.0 - low / 2.0; // the whole may be beyond doubles
  std::vector<double> values;
  for (int entry = -1; entry <= size; ++entry)
  {
    const double middle = 2.0 * (low / 2.0 + (entry + 0.5) * halfWidth / size);
    values.push_back(map.logarithmic ? std::pow(10.0, middle) : middle);
  }
  return filled(std::move(map), table, std::move(values));
}

Rgba8 opaque(const double* colour)
{
  Rgba8 bytes{ 0, 0, 0, 255 };
  for (std::size_t c = 0; c < 3; ++c)
  {
    bytes[c] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(colour[c], 0.0, 1.0)));
  }
  return bytes;
}

/// Tables of single values have none, and need none.
bool lacksRange(vtkScalarsToColors& table)
{
  const double* const range = table.GetRange();
  return !table.GetIndexedLookup() && !(std::isfinite(range[0]) && std::isfinite(range[1]));
}

/// A map of a range that is none: an infinite one, or NaN. All values have the colour of NaN.
/// VTK's tables are not asked: they would end the program.
ColourMap mapOfNothing(vtkScalarsToColors& table)
{
  auto* const entries = vtkLookupTable::SafeDownCast(&table);
  auto* const function = vtkColorTransferFunction::SafeDownCast(&table);
  constexpr double black[3] = { 0.0, 0.0, 0.0 };
  ColourMap map;
  map.missing =
    opaque(entries ? entries->GetNanColor() : (function ? function->GetNanColor() : black));
  map.below = map.above = map.missing;
  map.usesBelow = map.usesAbove = true;
  map.entries = { map.missing };
  return map;
}

} // namespace

bool hasPlainPointsOnly(const FrameShading& shading, const std::vector<LayerStyling>& layers)
{
  const auto plain = [](const std::shared_ptr<const ResolvedStyle>& style)
  {
    return style->technique == Technique::Points && style->filter.empty() && style->lens < 0 &&
      style->group == 0 && style->size.mode == SplatSize::Mode::Pixels &&
      style->second.combination == ColourCombination::None;
  };
  return !shading.anyLit() && !shading.anyEyeDome() && !shading.fillHoles &&
    shading.lenses.empty() && shading.highlights.empty() &&
    std::all_of(layers.begin(), layers.end(),
      [&](const LayerStyling& layer)
      { return std::all_of(layer.styles.begin(), layer.styles.end(), plain); });
}

ColourMap sampleColours(vtkScalarsToColors& table, const PointColouring& colouring)
{
  if (lacksRange(table))
  {
    return mapOfNothing(table);
  }
  return colouring.integers ? sampleIntegers(table, *colouring.integers) : sampleRange(table);
}

void MapperStyle::wantHeights(const std::shared_ptr<const StoredCloud>& store)
{
  if (!heights_ || heights_->store() != store)
  {
    heights_ = std::make_shared<ClassHeights>(store);
  }
}

std::optional<std::vector<LayerStyling>> MapperStyle::resolve(
  const StyleSheet& sheet, const std::shared_ptr<const StoredCloud>& store)
{
  if (sheetStore_ == store && sheet_ && sheet_->resolvesAs(sheet))
  {
    return layers_;
  }
  if (sheetStore_ != store || !ranges_)
  {
    ranges_ =
      std::make_shared<AttributeRanges>(std::vector<std::shared_ptr<const StoredCloud>>{ store });
  }
  sheet_ = sheet;
  sheetStore_ = store;
  StoreSurroundings surroundings;
  surroundings.ranges = ranges_.get();
  if (sheet.wantsHeights(store->description()))
  {
    wantHeights(store);
    surroundings.heights = heights_;
  }
  auto resolved = sheet.resolveAll(store->description(), surroundings);
  layers_.reset();
  pruning_.clear();
  if (!resolved)
  {
    error_ = resolved.error().what;
    return layers_;
  }
  layers_ = std::move(resolved).value();
  auto pruning = pruningOf(*store, *layers_);
  if (pruning)
  {
    pruning_ = std::move(pruning).value();
  }
  else
  {
    error_ = pruning.error().what; // all nodes are drawn, and each point is judged
  }
  return layers_;
}

std::vector<LayerStyling> MapperStyle::layersOf(vtkPolyDataMapper& mapper, vtkActor* actor,
  double pointSizePx, const StyleSheet* sheet, const std::shared_ptr<const StoredCloud>& store)
{
  if (const auto layers = sheet ? resolve(*sheet, store) : std::nullopt)
  {
    return *layers;
  }
  const std::size_t count = std::max<std::size_t>(1, store->description().layers.size());
  return { count, LayerStyling{ { update(mapper, actor, pointSizePx, store) }, 1.0 } };
}

PointColouring MapperStyle::colouringOf(
  vtkPolyDataMapper& mapper, const std::shared_ptr<const StoredCloud>& store)
{
  if (!mapper.GetScalarVisibility())
  {
    return {};
  }
  const StoreDescription& description = store->description();
  const ColourRequest request = colourRequestOf(mapper, description);
  if (PointColouring::wantsHeights(description, request))
  {
    wantHeights(store);
  }
  const bool heights = heights_ && heights_->store() == store;
  const auto colouring = PointColouring::choose(description, request, heights ? heights_ : nullptr);
  if (!colouring && unknownArray_ != request.name)
  {
    unknownArray_ = request.name;
    warning_ = "the store " + description.path + " has no attribute \"" + request.name +
      "\"; its points are drawn in the property's colour" +
      meantAttribute(description.schema, request.name);
  }
  if (colouring && colouring->usesTable())
  {
    tellOfTable(mapper, request.name,
      colouring->usesColumn() ? &description.schema[colouring->column] : nullptr,
      colouring->component);
  }
  return colouring.value_or(PointColouring{});
}

/// Warns where VTK's mappers would not use the table, or would use it in another way.
void MapperStyle::tellOfTable(
  vtkPolyDataMapper& mapper, const std::string& name, const Attribute* attribute, int component)
{
  if (mapper.GetColorMode() == VTK_COLOR_MODE_DIRECT_SCALARS && !directWarned_)
  {
    directWarned_ = true;
    warning_ = "the values of \"" + name +
      "\" are no colours (three or four components are); they are drawn by the lookup table, not "
      "as direct scalars";
  }
  vtkScalarsToColors* const table = mapper.GetLookupTable();
  const int components = attribute ? attribute->components : 1;
  if (component < 0 && table->GetVectorMode() == vtkScalarsToColors::MAGNITUDE &&
    table->GetVectorSize() > 0 && table->GetVectorSize() < components && !vectorsWarned_)
  {
    vectorsWarned_ = true;
    warning_ = "the magnitude of \"" + name +
      "\" is that of all its components: the table's VectorSize and VectorComponent do not choose "
      "among them";
  }
}

std::shared_ptr<const ColourMap> MapperStyle::mapOf(
  vtkPolyDataMapper& mapper, const PointColouring& colouring)
{
  if (!colouring.usesTable())
  {
    return nullptr;
  }
  vtkScalarsToColors* table = mapper.GetLookupTable(); // makes one if there is none
  table->Build();
  if (!mapper.GetUseLookupTableScalarRange())
  {
    table->SetRange(mapper.GetScalarRange());
  }
  if (table->GetIndexedLookup() && !colouring.integers && !indexedWarned_)
  {
    indexedWarned_ = true;
    warning_ = "an indexed lookup table needs an attribute of whole numbers with less than "
               "8192 different values; this one is drawn in the table's NaN colour";
  }
  if (lacksRange(*table) && !rangeWarned_)
  {
    rangeWarned_ = true;
    warning_ = "the range of the colour map is not finite; all points have its NaN colour. "
               "Give it a range of numbers";
  }
  if (!map_ || mapTable_ != table || mapTime_ != table->GetMTime() || mapColouring_ != colouring)
  {
    mapTable_ = table;
    mapColouring_ = colouring;
    map_ = std::make_shared<const ColourMap>(sampleColours(*table, colouring));
    mapTime_ = table->GetMTime(); // that of the table's alpha, which sampling changes and restores
  }
  return map_;
}

std::shared_ptr<const ResolvedStyle> MapperStyle::update(vtkPolyDataMapper& mapper, vtkActor* actor,
  double pointSizePx, const std::shared_ptr<const StoredCloud>& store)
{
  ResolvedStyle style;
  style.colouring = colouringOf(mapper, store);
  style.map = mapOf(mapper, style.colouring);
  if (style.map)
  {
    style.colouring.fitTo(*style.map);
  }
  style.flat = opaque(actor->GetProperty()->GetColor());
  style.opacity = actor->GetForceOpaque() ? 1.0 : actor->GetProperty()->GetOpacity();
  style.size.mode = SplatSize::Mode::Pixels;
  style.size.value = pointSizePx > 0.0 ? pointSizePx : actor->GetProperty()->GetPointSize();
  if (!style_ || *style_ != style)
  {
    style_ = std::make_shared<const ResolvedStyle>(std::move(style));
  }
  return style_;
}

} // namespace pointfront
