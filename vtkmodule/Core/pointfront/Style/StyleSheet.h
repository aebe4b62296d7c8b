#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Style/FrameShading.h"
#include "pointfront/Style/LayerStyle.h"
#include "pointfront/Style/ResolvedStyle.h"
#include "pointfront/Style/StyleLens.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

namespace pointfront
{

/// FrameShading::eyeDomeStrength of eye-dome lighting that is asked for without a number.
constexpr float usualEyeDomeStrength = 0.4f;

/// How one layer of a store is drawn.
struct LayerStyling
{
  /// One batch each, in the order of classes; empty: the layer is hidden, neither loaded nor drawn.
  /// A point passes the filter of one of them at most. Equal styles of a store are one object.
  std::vector<std::shared_ptr<const ResolvedStyle>> styles;
  double errorFactor = 1.0; ///< the smallest of what is visible (LayerLimits)
  double budgetShare = 0.0; ///< the largest; of a store with one tree for all classes 0

  bool visible() const { return !styles.empty(); }
  /// The columns that all of them read, ascending.
  ColumnSelection columns() const;
};

/// How a cloud is drawn: a default, the differences of each object class, and the work on the
/// pixels (LAYERS-8). It knows no store; resolve() looks its names up in one.
/// Unlayered  a store that keeps one tree for all classes: resolveAll() gives its layer one style
///            for each class that differs, with a filter on the column "classification".
/// Threads    a value.
struct StyleSheet
{
  LayerStyle standard; ///< the default
  std::map<std::uint8_t, LayerStyle> classes; ///< differences by class code
  /// Codes that are drawn, ascending; the others are hidden, whatever their styles say. Nothing:
  /// all.
  std::optional<std::vector<std::uint8_t>> shownClasses;
  FilterExpression where; ///< points have to pass it besides their style's own
  /// Its light and eye-dome lighting are for styles that say nothing of them; lights are the
  /// renderer's; lenses and highlights those below.
  FrameShading shading;
  std::vector<StyleLens> lenses;
  std::vector<StyleHighlight> highlights; ///< one for a class at most

  /// Complete: of the class, over the default, over standardStyle().
  LayerStyle styleOf(std::uint8_t objectClass) const;
  /// How it is drawn inside a lens, as a sheet without lenses.
  StyleSheet inside(const StyleLens& lens) const;
  /// Whether resolveAll() gives the same for both sheets: they differ at most in the places of
  /// lenses and in the work on pixels.
  bool resolvesAs(const StyleSheet& other) const;
  /// With its looks (StyleLooks.h), lenses and highlights.
  FrameShading frameShading() const;
  /// Whether any colour or condition asks for ClassHeights of this store.
  bool wantsHeights(const StoreDescription& store) const;
  /// Whether a class has a share of the budgets. Stores with one tree for all classes give it none.
  bool wantsShares() const;

  /// Layer number `layer`'s style with the store's columns looked up, visible or not; of an
  /// unlayered store the default.
  /// Errors  BadArgument: an attribute that the store has not, or of the wrong shape; what reading
  ///         a sample brings where a range is automatic (StoreSurroundings). The message begins
  ///         with the place in the sheet, as in JSON: "classes.5.color: ...".
  Result<std::shared_ptr<const ResolvedStyle>> resolve(const StoreDescription& store,
    std::size_t layer, const StoreSurroundings& surroundings = {}) const;
  /// All layers of the store. Errors of hidden layers are not met.
  Result<std::vector<LayerStyling>> resolveAll(
    const StoreDescription& store, const StoreSurroundings& surroundings = {}) const;

  friend bool operator==(const StyleSheet& a, const StyleSheet& b)
  {
    return a.standard == b.standard && a.classes == b.classes && a.shownClasses == b.shownClasses &&
      a.where == b.where && a.shading == b.shading && a.lenses == b.lenses &&
      a.highlights == b.highlights;
  }
  friend bool operator!=(const StyleSheet& a, const StyleSheet& b) { return !(a == b); }
};

/// False for a store that has one tree for the points of all classes.
bool isLayered(const StoreDescription& store);

} // namespace pointfront
