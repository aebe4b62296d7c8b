#include "pointfront/Style/StyleSheet.h"

#include "pointfront/Points/EnclosingRadius.h"
#include "pointfront/Style/ComponentName.h"
#include "pointfront/Style/TechniqueNames.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <glm/geometric.hpp>

namespace pointfront
{
namespace
{

constexpr const char* radiusColumnName = "splat_radius";
constexpr const char* heightColumnName = "height_above_ground";

using StylePointer = std::shared_ptr<const ResolvedStyle>;

Error placed(const std::string& place, const char* key, const Error& error)
{
  return makeError(error.kind, place + "." + key + ": " + error.what);
}

std::optional<std::uint32_t> scalarColumn(const StoreDescription& store, const std::string& name)
{
  const auto part = findComponent(store.schema, name);
  return part && (part->component || store.schema[part->column].components == 1)
    ? std::optional<std::uint32_t>(part->column)
    : std::nullopt;
}

std::optional<std::uint32_t> normalColumn(const StoreDescription& store)
{
  const std::optional<std::size_t> column = store.schema.find("normal");
  return column && store.schema[*column].components == 3
    ? std::optional<std::uint32_t>(static_cast<std::uint32_t>(*column))
    : std::nullopt;
}

/// A complete style with a store's columns.
class StyleResolution
{
public:
  StyleResolution(const StyleSheet& sheet, const LayerStyle& style, const StoreDescription& store,
    const StoreSurroundings& surroundings, std::string place)
    : sheet_(sheet)
    , style_(style)
    , store_(store)
    , surroundings_(surroundings)
    , place_(std::move(place))
  {
  }

  Result<ResolvedStyle> run()
  {
    resolved_.technique = *style_.technique;
    resolved_.accuracy = *style_.accuracy;
    resolved_.blended = *style_.blended;
    resolved_.opacity = *style_.opacity;
    if (resolved_.technique == Technique::Silhouettes)
    {
      resolved_.rim = *style_.rim;
    }
    orient();
    for (const auto step :
      { &StyleResolution::colour, &StyleResolution::size, &StyleResolution::solid,
        &StyleResolution::filter })
    {
      if (const Result<void> done = (this->*step)(); !done)
      {
        return done.error();
      }
    }
    return resolved_;
  }

private:
  void orient()
  {
    resolved_.orientation = style_.orientation->mode;
    const bool fixed = resolved_.orientation == SplatOrientation::Fixed;
    resolved_.fixedNormal =
      fixed ? glm::vec3(glm::normalize(style_.orientation->direction)) : glm::vec3(0, 0, 1);
    const bool turns = traitsOf(resolved_.technique).facing &&
      resolved_.orientation == SplatOrientation::Normal;
    const bool lit = sheet_.shading.lit && resolved_.technique != Technique::Spheres;
    if (turns || lit)
    {
      resolved_.normalColumn = normalColumn(store_);
    }
  }

  Result<void> colour()
  {
    const ColourSource& source = *style_.colour;
    const bool two = source.kind == ColourSource::Kind::Combination;
    const Result<ResolvedColour> first =
      resolveColour(two ? source.parts.at(0) : source, store_, surroundings_);
    if (!first)
    {
      return placed(place_, "color", first.error());
    }
    resolved_.colouring = first->colouring;
    resolved_.map = first->map;
    resolved_.flat = first->flat;
    if (!two)
    {
      return {};
    }
    const Result<ResolvedColour> second = resolveColour(source.parts.at(1), store_, surroundings_);
    if (!second)
    {
      return placed(place_, "color", second.error());
    }
    resolved_.second.combination = source.combination;
    resolved_.second.share256 = static_cast<std::uint32_t>(std::lround(256.0 * source.share));
    resolved_.second.colouring = second->colouring;
    resolved_.second.map = second->map;
    resolved_.second.flat = second->flat;
    return {};
  }

  Result<void> size()
  {
    const StyleSize& wanted = *style_.size;
    resolved_.size = { wanted.mode, wanted.value, 0 };
    if (wanted.mode == SplatSize::Mode::Spacing)
    {
      resolved_.radiusColumn = scalarColumn(store_, radiusColumnName);
    }
    if (wanted.mode == SplatSize::Mode::Attribute)
    {
      const std::string name =
        wanted.attribute.empty() ? std::string(enclosingRadiusName) : wanted.attribute;
      const auto column = scalarColumn(store_, name);
      if (!column || store_.schema[*column].components != 1)
      {
        return makeError(Error::Kind::BadArgument, place_ + ".size.attribute: " + store_.path +
          (column || store_.schema.find(name) ? ": '" + name + "' has several components"
                                              : " has no attribute '" + name + "'"));
      }
      resolved_.size.column = *column;
    }
    return {};
  }

  Result<void> solid()
  {
    if (resolved_.technique != Technique::Solid)
    {
      return {};
    }
    resolved_.wall = style_.wall;
    resolved_.heightColumn = scalarColumn(store_, heightColumnName);
    if (!resolved_.heightColumn)
    {
      return makeError(Error::Kind::BadArgument,
        place_ + ".technique: solid needs the attribute '" + heightColumnName + "', and " +
          store_.path + " has none: build it with --height-above-ground");
    }
    return {};
  }

  Result<void> filter()
  {
    const Result<PointFilter> common = sheet_.where.resolve(store_);
    if (!common)
    {
      return makeError(common.error().kind, "where: " + common.error().what);
    }
    const Result<PointFilter> own = style_.where->resolve(store_);
    if (!own)
    {
      return placed(place_, "where", own.error());
    }
    resolved_.filter = *common;
    resolved_.filter.conditions.insert(
      resolved_.filter.conditions.end(), own->conditions.begin(), own->conditions.end());
    return {};
  }

  const StyleSheet& sheet_;
  const LayerStyle& style_;
  const StoreDescription& store_;
  const StoreSurroundings& surroundings_;
  std::string place_;
  ResolvedStyle resolved_;
};

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

/// Classes of an unlayered store that are drawn in one way.
struct ClassGroup
{
  LayerStyle style; ///< complete
  std::string place;
  std::vector<std::uint8_t> codes; ///< ascending; of the first group, `inverted`, those it has not
  bool inverted = false;
};

/// The default's group, if any class is left to it, and those of classes that differ.
std::vector<ClassGroup> classGroups(const StyleSheet& sheet)
{
  ClassGroup others{ sheet.standard.over(standardStyle()), "default", {}, true };
  std::vector<ClassGroup> groups;
  const auto join = [&groups](const LayerStyle& style, const std::string& place, std::uint8_t code)
  {
    const auto same = std::find_if(groups.begin(), groups.end(),
      [&style](const ClassGroup& group) { return group.style == style; });
    if (same != groups.end())
    {
      same->codes.push_back(code);
      return;
    }
    groups.push_back({ style, place, { code }, false });
  };
  for (int code = 0; code < 256; ++code)
  {
    const auto objectClass = static_cast<std::uint8_t>(code);
    const LayerStyle style = sheet.styleOf(objectClass);
    const bool shown = isShown(sheet, objectClass) && *style.visible;
    const bool differs = style != others.style || sheet.shownClasses;
    if (shown && differs)
    {
      join(style, placeOf(sheet, objectClass), objectClass);
    }
    if (!shown || differs)
    {
      others.codes.push_back(objectClass);
    }
  }
  if (*others.style.visible && others.codes.size() < 256)
  {
    groups.insert(groups.begin(), std::move(others));
  }
  return groups;
}

} // namespace

ColumnSelection LayerStyling::columns() const
{
  std::set<std::uint32_t> all;
  for (const StylePointer& style : styles)
  {
    const ColumnSelection columns = style->columns();
    all.insert(columns.begin(), columns.end());
  }
  return ColumnSelection(all.begin(), all.end());
}

bool isLayered(const StoreDescription& store)
{
  return store.layers.size() > 1 ||
    (store.layers.size() == 1 && store.layers.front().name != "all");
}

LayerStyle StyleSheet::styleOf(std::uint8_t objectClass) const
{
  const LayerStyle below = standard.over(standardStyle());
  const auto own = classes.find(objectClass);
  return own == classes.end() ? below : own->second.over(below);
}

bool StyleSheet::wantsHeights(const StoreDescription& store) const
{
  const auto asks = [&store](const ColourSource& source)
  {
    ColourRequest request;
    request.name = withUnderscores(source.attribute);
    return source.kind == ColourSource::Kind::Attribute &&
      PointColouring::wantsHeights(store, request);
  };
  const auto styleAsks = [&asks](const LayerStyle& style)
  {
    return style.colour &&
      (asks(*style.colour) ||
        std::any_of(style.colour->parts.begin(), style.colour->parts.end(), asks));
  };
  return styleAsks(standard) ||
    std::any_of(classes.begin(), classes.end(),
      [&](const auto& ofClass) { return styleAsks(ofClass.second); });
}

Result<StylePointer> StyleSheet::resolve(const StoreDescription& store, std::size_t layer,
  const StoreSurroundings& surroundings) const
{
  const bool layered = isLayered(store);
  const auto objectClass =
    static_cast<std::uint8_t>(layered ? store.layers[layer].objectClass : 0);
  const LayerStyle style =
    layered ? styleOf(objectClass) : standard.over(standardStyle());
  Result<ResolvedStyle> resolved = StyleResolution(*this, style, store, surroundings,
    layered ? placeOf(*this, objectClass) : "default").run();
  if (!resolved)
  {
    return resolved.error();
  }
  return StylePointer(std::make_shared<const ResolvedStyle>(std::move(*resolved)));
}

Result<std::vector<LayerStyling>> StyleSheet::resolveAll(
  const StoreDescription& store, const StoreSurroundings& surroundings) const
{
  DistinctStyles distinct;
  std::vector<LayerStyling> layers;
  const auto add = [&](LayerStyling& layer, const LayerStyle& style, const std::string& place,
                     const AttributeCondition* condition) -> Result<void>
  {
    Result<ResolvedStyle> resolved =
      StyleResolution(*this, style, store, surroundings, place).run();
    if (!resolved)
    {
      return resolved.error();
    }
    if (condition)
    {
      resolved->filter.conditions.push_back(*condition);
    }
    layer.errorFactor = layer.styles.empty() ? *style.errorFactor
                                             : std::min(layer.errorFactor, *style.errorFactor);
    layer.styles.push_back(distinct.add(std::move(*resolved)));
    return {};
  };
  if (isLayered(store))
  {
    for (const Layer& of : store.layers)
    {
      LayerStyling layer;
      const auto objectClass = static_cast<std::uint8_t>(of.objectClass);
      const LayerStyle style = styleOf(objectClass);
      if (isShown(*this, objectClass) && *style.visible)
      {
        if (const auto done = add(layer, style, placeOf(*this, objectClass), nullptr); !done)
        {
          return done.error();
        }
      }
      layers.push_back(std::move(layer));
    }
    return layers;
  }

  LayerStyling all;
  const auto column = scalarColumn(store, "classification");
  if (shownClasses && !column)
  {
    return makeError(Error::Kind::BadArgument,
      store.path + ": no point has a class here, so none can be shown alone");
  }
  for (const ClassGroup& group : classGroups(*this))
  {
    AttributeCondition condition = classIsIn(column.value_or(0), group.codes);
    condition.inverted = group.inverted;
    const bool everything = group.inverted && group.codes.empty();
    if (!column && !group.inverted)
    {
      continue; // points without a class are drawn by the default
    }
    const bool conditional = column && !everything;
    if (const auto done = add(all, group.style, group.place, conditional ? &condition : nullptr);
        !done)
    {
      return done.error();
    }
  }
  return std::vector<LayerStyling>(std::max<std::size_t>(1, store.layers.size()), all);
}

} // namespace pointfront
