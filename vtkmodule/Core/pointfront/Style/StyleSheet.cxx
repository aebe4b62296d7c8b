#include "pointfront/Style/StyleSheet.h"

#include "pointfront/Base/NearestName.h"
#include "pointfront/Disk/Epoch.h"
#include "pointfront/Points/AttributeNames.h"
#include "pointfront/Points/EnclosingRadius.h"
#include "pointfront/Style/ComponentName.h"
#include "pointfront/Style/StyleLooks.h"
#include "pointfront/Style/StyleResolution.h"
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

std::string listOf(const std::vector<std::string>& epochs)
{
  std::string list;
  for (const std::string& epoch : epochs)
  {
    list += (list.empty() ? "" : ", ") + (epoch.empty() ? "one without a name" : epoch);
  }
  return list;
}

/// The condition that points of one epoch meet.
Result<AttributeCondition> epochIs(const std::string& name, const StoreDescription& store)
{
  const auto found = std::find(store.epochs.begin(), store.epochs.end(), name);
  if (store.epochColumn && found != store.epochs.end())
  {
    AttributeCondition condition;
    condition.column = *store.epochColumn;
    condition.values = { store.epochTimes[static_cast<std::size_t>(found - store.epochs.begin())] };
    return condition;
  }
  const bool named = !store.epochs.empty() && !store.epochs.back().empty();
  const auto asked = EpochAddress::of(store.path).epoch;
  return makeError(Error::Kind::BadArgument,
    store.path +
      (!named ? " has no epochs; tiles of a collection have (collection add --epoch)"
          : !store.epochColumn ? ": an older version wrote it, with several epochs in one tree; "
                                 "'pointfront collection compact' makes a tree of each"
          : asked              ? " shows one epoch alone: leave that out to see '" + name + "', too"
                               : " has no epoch '" + name + "'; it has: " + listOf(store.epochs) +
            didYouMean(name, store.epochs)));
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
    for (const auto step : { &StyleResolution::colour, &StyleResolution::size,
           &StyleResolution::solid, &StyleResolution::filter })
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
    // An orientation is of discs: all else has the points' normals for its light.
    const bool disc = traitsOf(resolved_.technique).facing;
    const SplatOrientation wanted = style_.orientation->mode;
    const bool automatic = wanted == SplatOrientation::Automatic;
    resolved_.orientation = disc && !automatic ? wanted : SplatOrientation::Normal;
    const bool fixed = resolved_.orientation == SplatOrientation::Fixed;
    resolved_.fixedNormal =
      fixed ? glm::vec3(glm::normalize(style_.orientation->direction)) : glm::vec3(0, 0, 1);
    // Light falls on the disc that is drawn: one with an orientation of its own needs no normal.
    const bool lit =
      lookOf(style_, sheet_.shading).lit && resolved_.technique != Technique::Spheres;
    if (resolved_.orientation == SplatOrientation::Normal && (disc || lit))
    {
      const std::optional<std::uint32_t> column = normalColumn(store_);
      const bool worth = lit || !automatic || resolved_.technique == Technique::Ewa;
      resolved_.normalColumn =
        column && (worth || !store_.isComputed(*column)) ? column : std::nullopt;
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
        return makeError(Error::Kind::BadArgument,
          place_ + ".size.attribute: " + store_.path +
            (column || store_.schema.find(name)
                ? ": '" + name + "' has several components"
                : " has no attribute '" + name + "'" + meantAttribute(store_.schema, name)));
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
    const Result<PointFilter> common = sheet_.where.resolve(store_, surroundings_.heights);
    if (!common)
    {
      return makeError(common.error().kind, "where: " + common.error().what);
    }
    const Result<PointFilter> own = style_.where->resolve(store_, surroundings_.heights);
    if (!own)
    {
      return placed(place_, "where", own.error());
    }
    if (style_.epoch)
    {
      const Result<AttributeCondition> epoch = epochIs(*style_.epoch, store_);
      if (!epoch)
      {
        return placed(place_, "epoch", epoch.error());
      }
      resolved_.filter.conditions.push_back(*epoch);
    }
    resolved_.filter.conditions.insert(
      resolved_.filter.conditions.end(), common->conditions.begin(), common->conditions.end());
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

} // namespace

Result<ResolvedStyle> resolveStyle(const StyleSheet& sheet, const LayerStyle& style,
  const StoreDescription& store, const StoreSurroundings& surroundings, std::string place)
{
  return StyleResolution(sheet, style, store, surroundings, std::move(place)).run();
}

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
  const auto styleAsks = [&](const LayerStyle& style)
  {
    const bool colourAsks = style.colour &&
      (asks(*style.colour) ||
        std::any_of(style.colour->parts.begin(), style.colour->parts.end(), asks));
    return colourAsks || (style.where && style.where->wantsHeights(store));
  };
  const auto anyAsks = [&styleAsks](const LayerStyle& one, const auto& ofClasses)
  {
    return styleAsks(one) ||
      std::any_of(ofClasses.begin(), ofClasses.end(),
        [&](const auto& ofClass) { return styleAsks(ofClass.second); });
  };
  return where.wantsHeights(store) || anyAsks(standard, classes) ||
    std::any_of(lenses.begin(), lenses.end(),
      [&](const StyleLens& lens) { return anyAsks(lens.standard, lens.classes); });
}

bool StyleSheet::wantsShares() const
{
  const auto asks = [](const LayerStyle& style) { return style.budgetShare.value_or(0.0) > 0.0; };
  return asks(standard) ||
    std::any_of(
      classes.begin(), classes.end(), [&](const auto& ofClass) { return asks(ofClass.second); });
}

Result<StylePointer> StyleSheet::resolve(
  const StoreDescription& store, std::size_t layer, const StoreSurroundings& surroundings) const
{
  const bool layered = isLayered(store);
  const auto objectClass = static_cast<std::uint8_t>(layered ? store.layers[layer].objectClass : 0);
  const LayerStyle style = layered ? styleOf(objectClass) : standard.over(standardStyle());
  const bool own = layered && classes.count(objectClass) > 0;
  Result<ResolvedStyle> resolved = resolveStyle(
    *this, style, store, surroundings, own ? "classes." + std::to_string(objectClass) : "default");
  if (!resolved)
  {
    return resolved.error();
  }
  resolved->look = StyleLooks(*this).numberOf(style);
  return StylePointer(std::make_shared<const ResolvedStyle>(std::move(*resolved)));
}

StyleSheet StyleSheet::inside(const StyleLens& lens) const
{
  StyleSheet sheet = *this;
  sheet.lenses.clear();
  sheet.standard = lens.standard.over(standard);
  for (auto& [code, style] : sheet.classes)
  {
    style = lens.standard.over(style);
  }
  for (const auto& [code, style] : lens.classes)
  {
    const auto own = sheet.classes.find(code);
    sheet.classes[code] = style.over(own == sheet.classes.end() ? lens.standard : own->second);
  }
  return sheet;
}

bool StyleSheet::resolvesAs(const StyleSheet& other) const
{
  const auto rest = [](const StyleSheet& of)
  {
    StyleSheet sheet = of;
    sheet.shading = FrameShading();
    sheet.shading.lit = of.shading.lit;
    for (StyleLens& lens : sheet.lenses)
    {
      const float size = lens.place.coversNothing() ? 0.0f : 1.0f;
      const LensShape shape = lens.place.shape;
      lens.place = FrameLens();
      lens.place.shape = shape;
      lens.place.halfSizePx = glm::vec2(size);
    }
    return sheet;
  };
  return rest(*this) == rest(other) && StyleLooks(*this).numbers() == StyleLooks(other).numbers();
}

FrameShading StyleSheet::frameShading() const
{
  FrameShading frame = shading;
  const std::vector<FrameLook> looks = StyleLooks(*this).looks();
  static_cast<FrameLook&>(frame) = looks.front();
  frame.furtherLooks.assign(looks.begin() + 1, looks.end());
  for (const StyleLens& lens : lenses)
  {
    frame.lenses.push_back(lens.place);
  }
  for (const StyleHighlight& highlight : highlights)
  {
    const glm::vec3 colour(highlight.colour[0], highlight.colour[1], highlight.colour[2]);
    frame.highlights.push_back({ colour / 255.0f, highlight.haloPx, highlight.tint });
  }
  return frame;
}

} // namespace pointfront
