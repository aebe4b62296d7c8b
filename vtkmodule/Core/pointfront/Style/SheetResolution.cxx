#include "pointfront/Style/ComponentName.h"
#include "pointfront/Style/StyleLooks.h"
#include "pointfront/Style/StyleResolution.h"
#include "pointfront/Style/StyleSheet.h"

#include <algorithm>
#include <string>
#include <utility>

namespace pointfront
{
namespace
{

using StylePointer = std::shared_ptr<const ResolvedStyle>;

/// The group of what is translucent and has no style of its own.
constexpr std::uint16_t groupOfOthers = 257;

std::optional<std::uint32_t> classColumnOf(const StoreDescription& store)
{
  const auto part = findComponent(store.schema, "classification");
  return part && store.schema[part->column].components == 1
    ? std::optional<std::uint32_t>(part->column)
    : std::nullopt;
}

/// Styles of one store: equal ones are one object.
class DistinctStyles
{
public:
  StylePointer add(ResolvedStyle style)
  {
    for (const StylePointer& known : styles_)
    {
      if (*known == style)
      {
        return known;
      }
    }
    styles_.push_back(std::make_shared<const ResolvedStyle>(std::move(style)));
    return styles_.back();
  }

private:
  std::vector<StylePointer> styles_;
};

bool isShown(const StyleSheet& sheet, std::uint8_t objectClass)
{
  return !sheet.shownClasses ||
    std::binary_search(sheet.shownClasses->begin(), sheet.shownClasses->end(), objectClass);
}

/// `style` is complete.
bool isSeen(const LayerStyle& style)
{
  return *style.visible && *style.opacity > 0.0;
}

std::string placeOf(const StyleSheet& sheet, std::uint8_t objectClass)
{
  return sheet.classes.count(objectClass) > 0 ? "classes." + std::to_string(objectClass)
                                              : "default";
}

AttributeCondition classIsIn(std::uint32_t column, const std::vector<std::uint8_t>& codes)
{
  AttributeCondition condition;
  condition.column = column;
  condition.values.assign(codes.begin(), codes.end());
  return condition;
}

/// 1 + number of the class's highlight; 0: it has none.
std::uint8_t highlightOf(const StyleSheet& sheet, std::uint8_t objectClass)
{
  const auto found = std::find_if(sheet.highlights.begin(), sheet.highlights.end(),
    [&](const StyleHighlight& one) { return one.objectClass == objectClass; });
  const auto number = static_cast<std::uint8_t>(found - sheet.highlights.begin());
  return found == sheet.highlights.end() ? 0 : static_cast<std::uint8_t>(number + 1);
}

/// The group of what is translucent: a class that has a style of its own makes one.
std::uint16_t groupOf(const StyleSheet& sheet, std::uint8_t objectClass)
{
  return sheet.classes.count(objectClass) > 0 ? static_cast<std::uint16_t>(objectClass + 1)
                                              : groupOfOthers;
}

/// ResolvedStyle::group of a class with that style.
std::uint16_t surfaceOf(const StyleSheet& sheet, const LayerStyle& style, std::uint8_t objectClass)
{
  return style.opacity && *style.opacity < 1.0 ? groupOf(sheet, objectClass) : std::uint16_t(0);
}

/// Classes of an unlayered store that are drawn in one way.
struct ClassGroup
{
  LayerStyle style; ///< complete
  std::uint16_t surface = 0;
  std::uint8_t highlight = 0;
  std::string place;
  std::vector<std::uint8_t> codes; ///< ascending; of the first group, `inverted`, those it has not
  bool inverted = false;
};

/// The default's group, if any class is left to it, and those of classes that differ.
std::vector<ClassGroup> classGroups(const StyleSheet& sheet)
{
  ClassGroup others{ sheet.standard.over(standardStyle()), 0, 0, "default", {}, true };
  const bool translucent = others.style.opacity && *others.style.opacity < 1.0;
  others.surface = translucent ? groupOfOthers : std::uint16_t(0);
  std::vector<ClassGroup> groups;
  const auto join = [&](const LayerStyle& style, std::uint8_t code)
  {
    const std::uint8_t highlight = highlightOf(sheet, code);
    const std::uint16_t surface = surfaceOf(sheet, style, code);
    const auto same = std::find_if(groups.begin(), groups.end(),
      [&](const ClassGroup& group)
      { return group.style == style && group.surface == surface && group.highlight == highlight; });
    if (same != groups.end())
    {
      same->codes.push_back(code);
      return;
    }
    groups.push_back({ style, surface, highlight, placeOf(sheet, code), { code }, false });
  };
  for (int code = 0; code < 256; ++code)
  {
    const auto objectClass = static_cast<std::uint8_t>(code);
    const LayerStyle style = sheet.styleOf(objectClass);
    const bool shown = isShown(sheet, objectClass) && isSeen(style);
    const bool differs = style != others.style ||
      surfaceOf(sheet, style, objectClass) != others.surface || sheet.shownClasses ||
      highlightOf(sheet, objectClass) > 0;
    if (shown && differs)
    {
      join(style, objectClass);
    }
    if (!shown || differs)
    {
      others.codes.push_back(objectClass);
    }
  }
  if (isSeen(others.style) && others.codes.size() < 256)
  {
    groups.insert(groups.begin(), std::move(others));
  }
  return groups;
}

/// All layers of a store by a sheet, and by what the sheet is inside each of its lenses.
class SheetResolution
{
public:
  SheetResolution(
    const StyleSheet& sheet, const StoreDescription& store, const StoreSurroundings& surroundings)
    : store_(store)
    , surroundings_(surroundings)
    , looks_(sheet)
    , classColumn_(classColumnOf(store))
    , layers_(std::max<std::size_t>(isLayered(store) ? 0 : 1, store.layers.size()))
  {
  }

  Result<std::vector<LayerStyling>> run(const StyleSheet& sheet)
  {
    Result<void> done = add(sheet, noLens);
    for (std::size_t number = 0; done && number < sheet.lenses.size(); ++number)
    {
      const StyleLens& lens = sheet.lenses[number];
      if (!lens.place.coversNothing())
      {
        const auto lensNumber = static_cast<std::int16_t>(number);
        done = add(sheet.inside(lens), lensNumber);
        const bool masked = lens.place.shape == LensShape::AroundClass;
        done = done && masked ? addMask(lens, lensNumber) : done;
      }
    }
    if (!done)
    {
      return done.error();
    }
    return std::move(layers_);
  }

private:
  static constexpr std::int16_t noLens = -1;

  Result<void> add(const StyleSheet& sheet, std::int16_t lens)
  {
    return isLayered(store_) ? addLayers(sheet, lens) : addGroups(sheet, lens);
  }

  Result<void> addLayers(const StyleSheet& sheet, std::int16_t lens)
  {
    for (std::size_t number = 0; number < store_.layers.size(); ++number)
    {
      const auto objectClass = static_cast<std::uint8_t>(store_.layers[number].objectClass);
      const LayerStyle style = sheet.styleOf(objectClass);
      if (isShown(sheet, objectClass) && isSeen(style))
      {
        auto resolved = resolve(sheet, style, placeOf(sheet, objectClass), lens);
        if (!resolved)
        {
          return resolved.error();
        }
        resolved->group = surfaceOf(sheet, style, objectClass);
        resolved->highlight = highlightOf(sheet, objectClass);
        put(layers_[number], *style.errorFactor, std::move(*resolved));
        layers_[number].budgetShare = std::max(layers_[number].budgetShare, *style.budgetShare);
      }
    }
    return {};
  }

  Result<void> addGroups(const StyleSheet& sheet, std::int16_t lens)
  {
    if (sheet.shownClasses && !classColumn_)
    {
      return makeError(Error::Kind::BadArgument,
        store_.path + ": no point has a class here, so none can be shown alone");
    }
    for (const ClassGroup& group : classGroups(sheet))
    {
      if (!classColumn_ && !group.inverted)
      {
        continue; // points without a class are drawn by the default
      }
      auto resolved = resolve(sheet, group.style, group.place, lens);
      if (!resolved)
      {
        return resolved.error();
      }
      const bool everything = group.inverted && group.codes.empty();
      if (classColumn_ && !everything)
      {
        AttributeCondition condition = classIsIn(*classColumn_, group.codes);
        condition.inverted = group.inverted;
        resolved->filter.conditions.push_back(std::move(condition));
      }
      resolved->group = group.surface;
      resolved->highlight = group.highlight;
      for (LayerStyling& layer : layers_)
      {
        put(layer, *group.style.errorFactor, *resolved);
      }
    }
    return {};
  }

  /// Adds the mask of points of the class, each with a disc that faces the eye.
  Result<void> addMask(const StyleLens& lens, std::int16_t number)
  {
    ResolvedStyle mask;
    mask.technique = Technique::Points;
    mask.size = { SplatSize::Mode::World, 2.0 * lens.aroundRadius, 0 };
    mask.orientation = SplatOrientation::View;
    mask.lens = number;
    mask.lensMask = true;
    if (!isLayered(store_) && !classColumn_)
    {
      return {}; // no point has a class: the lens covers nothing
    }
    if (!isLayered(store_))
    {
      mask.filter.conditions.push_back(classIsIn(*classColumn_, { lens.aroundClass }));
    }
    for (std::size_t layer = 0; layer < layers_.size(); ++layer)
    {
      if (!isLayered(store_) || store_.layers[layer].objectClass == lens.aroundClass)
      {
        put(layers_[layer], 1.0, mask);
      }
    }
    return {};
  }

  Result<ResolvedStyle> resolve(const StyleSheet& sheet, const LayerStyle& style,
    const std::string& place, std::int16_t lens) const
  {
    const std::string inside = "lenses[" + std::to_string(lens) + "].inside: ";
    Result<ResolvedStyle> resolved =
      resolveStyle(sheet, style, store_, surroundings_, lens == noLens ? place : inside + place);
    if (resolved)
    {
      resolved->lens = lens;
      resolved->look = looks_.numberOf(style);
    }
    return resolved;
  }

  void put(LayerStyling& layer, double errorFactor, ResolvedStyle style)
  {
    layer.errorFactor =
      layer.styles.empty() ? errorFactor : std::min(layer.errorFactor, errorFactor);
    layer.styles.push_back(distinct_.add(std::move(style)));
  }

  const StoreDescription& store_;
  const StoreSurroundings& surroundings_;
  StyleLooks looks_;
  std::optional<std::uint32_t> classColumn_;
  DistinctStyles distinct_;
  std::vector<LayerStyling> layers_;
};

} // namespace

Result<std::vector<LayerStyling>> StyleSheet::resolveAll(
  const StoreDescription& store, const StoreSurroundings& surroundings) const
{
  return SheetResolution(*this, store, surroundings).run(*this);
}

} // namespace pointfront
