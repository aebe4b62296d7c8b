#pragma once

#include "pointfront/Front/NodePruning.h"
#include "pointfront/Front/SightWindow.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace pointfront
{

/// The limits of one layer (an object class with a tree of its own): its switch, its error and its
/// share of the budgets.
/// Source  Richter, Discher & Doellner 2015, section 4.2 (LAYERS-11).
struct LayerLimits
{
  /// A hidden layer is not drawn, asks for nothing, and leaves its share to the others.
  bool visible = true;
  /// Its threshold is the view's times this, > 0: 2 draws the layer half as fine. Its errors are
  /// divided by it wherever layers are compared (thresholds, priorities, FrontDelta::errorPx).
  double errorFactor = 1.0;
  /// The share of pointBudget and heldPointBudget, 0 to 1, that the layer gets before any other,
  /// however large their errors are. An unused part of the share is lent to the layers with the
  /// largest errors and taken back at the next update that needs it. 0: the layer takes from the
  /// rest. Shares that come to more than 1 over the visible layers are cut down in proportion.
  double share = 0.0;
  /// Nodes of the layer that its filter leaves out. They are neither requested nor drawn, as if
  /// they had no points; the same goes for everything below skipped nodes. Null: no node. Compared
  /// by object.
  std::shared_ptr<const NodePruning> pruning = nullptr;
  /// The parts of the view in which the layer is seen; empty: all of it. Elsewhere it is out of
  /// sight.
  std::vector<SightWindow> windows{};

  bool sees(const glm::dvec3& centre, double radius, double spacing) const
  {
    return windows.empty() ||
      std::any_of(windows.begin(), windows.end(),
        [&](const SightWindow& window) { return window.sees(centre, radius, spacing); });
  }
};

/// Limits of a layer by its number; layers beyond the list have the default.
inline const LayerLimits& limitsOfLayer(const std::vector<LayerLimits>& layers, std::size_t layer)
{
  static const LayerLimits byDefault;
  return layer < layers.size() ? layers[layer] : byDefault;
}

/// Those of a node's `points` that its pruning leaves; nothing where its whole subtree has none.
inline std::optional<std::uint32_t> drawablePoints(
  const LayerLimits& limits, NodeIndex node, std::uint32_t points)
{
  const auto verdict = limits.pruning ? limits.pruning->of(node) : NodePruning::Verdict::Draw;
  if (verdict == NodePruning::Verdict::Skip)
  {
    return std::nullopt;
  }
  return verdict == NodePruning::Verdict::Draw ? points : 0;
}

inline bool operator==(const LayerLimits& a, const LayerLimits& b)
{
  return a.visible == b.visible && a.errorFactor == b.errorFactor && a.share == b.share &&
    a.pruning == b.pruning && a.windows == b.windows;
}

} // namespace pointfront
