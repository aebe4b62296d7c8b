#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Style/AttributeRanges.h"
#include "pointfront/Style/ColourCombination.h"
#include "pointfront/Style/ColourMap.h"
#include "pointfront/Style/PointColouring.h"

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// Colours for the values of an attribute.
struct ColourMapChoice
{
  enum class Kind : std::uint8_t
  {
    Automatic, ///< classification: its table; intensity: grey; colours and normals as they are;
               ///< all else viridis
    Viridis,
    Grey,
    Classification, ///< a colour for each whole number 0 to 255 (ASPRS)
    Colours, ///< `colours`, at equal distances, linear between two
    Direct ///< the three or four components are the colour
  };
  Kind kind = Kind::Automatic;
  std::vector<Rgba8> colours;
  /// World units, low < high; nothing: of AttributeRanges.
  std::optional<std::array<double, 2>> range;
  bool logarithmic = false; ///< range > 0 then

  friend bool operator==(const ColourMapChoice& a, const ColourMapChoice& b)
  {
    return a.kind == b.kind && a.colours == b.colours && a.range == b.range &&
      a.logarithmic == b.logarithmic;
  }
};

/// The source of the points' colours, by name: any attribute, a constant, or a combination of two
/// (LAYERS-8).
struct ColourSource
{
  enum class Kind : std::uint8_t
  {
    Automatic, ///< the attribute that says most of the store: defaultColourAttribute()
    Constant,
    Attribute, ///< a name: an attribute, a component (ComponentName.h), elevation, horizontality
               ///< or global_height
    Combination ///< two sources, neither of them a combination
  };
  Kind kind = Kind::Automatic;
  Rgba8 constant{ 255, 255, 255, 255 };
  std::string attribute;
  ColourMapChoice map;
  ColourCombination combination = ColourCombination::None;
  double share = 0.5; ///< Mix: of the second, 0 to 1
  std::vector<ColourSource> parts; ///< the two parts of a combination

  static ColourSource ofAttribute(std::string name, ColourMapChoice map = {});
  static ColourSource ofConstant(const Rgba8& colour);
  static ColourSource ofTwo(
    ColourCombination combination, ColourSource first, ColourSource second, double share = 0.5);

  friend bool operator==(const ColourSource& a, const ColourSource& b)
  {
    return a.kind == b.kind && a.constant == b.constant && a.attribute == b.attribute &&
      a.map == b.map && a.combination == b.combination && a.share == b.share && a.parts == b.parts;
  }
  friend bool operator!=(const ColourSource& a, const ColourSource& b) { return !(a == b); }
};

/// Facts that a style may ask for and that a store's description lacks.
struct StoreSurroundings
{
  /// Heights in the store: for global_height.
  std::shared_ptr<const ClassHeights> heights;
  /// The ranges over all stores of the picture. Missing ranges come from it, and an attribute that
  /// another store has and this store lacks leaves this store white. Null: the store stands alone,
  /// and its whole range is taken.
  const AttributeRanges* ranges = nullptr;
};

/// A source that is not a combination, with a store's columns looked up.
struct ResolvedColour
{
  PointColouring colouring;
  std::shared_ptr<const ColourMap> map; ///< where the colouring uses a table; else null
  Rgba8 flat{ 255, 255, 255, 255 }; ///< where it is Flat
};

/// BadArgument names the attribute that is missing, and how to get it where that is known.
Result<ResolvedColour> resolveColour(
  const ColourSource& source, const StoreDescription& store, const StoreSurroundings& surroundings);

/// The attribute that is drawn when the user names none: rgb if the store has any colour, else
/// classification if there are several classes, else intensity if it varies, else elevation.
std::string defaultColourAttribute(const StoreDescription& store);

/// "#rrggbb"; nothing for another text.
std::optional<Rgba8> parseColourCode(const std::string& text);
std::string colourCode(const Rgba8& colour);

} // namespace pointfront
