#pragma once

#include "DrawnItem.h"
#include "ItemNumbers.h"
#include "RasterBatch.h"

#include "pointfront/Plan/FramePlan.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{
class ThreadCrew;

/// What the last picture showed, kept while the view moves: points that were visible, at most one a
/// pixel, and that the next plan does not draw. They are copied together, so that the nodes they
/// come from may leave the memory (SMOOTH-7; drawing.md 7).
/// Threads  one thread at a time; works with those of a crew.
class VisiblePoints
{
public:
  /// Looks for them: in the keys of the last picture, who won and is not in the plan.
  /// `numbers`, `drawn`: what the keys' indices mean, an item each.
  void choose(const RasterKey* keys, const RasterWindow& window, const ItemNumbers& numbers,
    const std::vector<DrawnItem>& drawn, const FramePlan& plan, ThreadCrew& crew);
  /// Adds them to the plan's batches, as nodes of their own.
  void addTo(FramePlan& plan) const;
  bool empty() const { return kept_.empty(); }
  std::uint64_t count() const;
  void clear() { kept_.clear(); }

private:
  /// Points of one node.
  struct Kept
  {
    std::shared_ptr<const NodeColumns> columns;
    std::vector<std::uint32_t> indices; ///< in the node, ascending
    PlanItem item;                      ///< how it was drawn
  };
  struct Source;
  struct Place;
  std::vector<Source> sourcesOf(
    const std::vector<DrawnItem>& drawn, const FramePlan& plan) const;
  static void markVisible(const RasterKey* row, int width, const ItemNumbers& numbers,
    const std::vector<Source>& sources);
  void gather(const std::vector<Source>& sources, ThreadCrew& crew);
  static std::vector<Place> placesOf(const std::vector<const Source*>& parts);
  static std::shared_ptr<const NodeColumns> copied(
    const NodeColumns& model, const std::vector<Place>& places);

  std::vector<Kept> kept_;
};

} // namespace pointfront
