#pragma once

#include "pointfront/Front/NodePruning.h"

#include <memory>

namespace pointfront
{

/// What one layer (object class with a tree of its own) asks of a view and may have of its budgets.
/// Source  Richter, Discher & Doellner 2015, section 4.2 (LAYERS-11).
struct LayerLimits
{
  /// A hidden layer is not drawn, asks for nothing, and leaves its share to the others.
  bool visible = true;
  /// Its threshold is the view's times this, > 0: 2 draws the layer half as fine. Its errors are
  /// divided by it wherever layers are compared (thresholds, priorities, FrontDelta::errorPx).
  double errorFactor = 1.0;
  /// Of pointBudget and heldPointBudget, 0 to 1: so much the layer has before any other, however
  /// large their errors are. What it does not use is lent to those with the largest errors and
  /// taken back at the next update that needs it. 0: it takes from what is left. Shares that come
  /// to more than 1 over the visible layers are cut down in proportion.
  double share = 0.0;
  /// Nodes of the layer that its filter leaves out: neither asked for nor drawn, as if they had no
  /// points; nor is anything below those that are skipped. Null: there is none. Compared by object.
  std::shared_ptr<const NodePruning> pruning = nullptr;
};

inline bool operator==(const LayerLimits& a, const LayerLimits& b)
{
  return a.visible == b.visible && a.errorFactor == b.errorFactor && a.share == b.share &&
    a.pruning == b.pruning;
}

} // namespace pointfront
