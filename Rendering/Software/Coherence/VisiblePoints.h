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
/// come from may leave the memory (SMOOTH-7).
/// Threads  one thread at a time; works with those of a crew.
class VisiblePoints
{
public:
  /// What was drawn: the keys of the last picture, and what their indices mean, an item each.
  struct Drawn
  {
    const RasterKey* keys;
    const RasterWindow& window;
    const ItemNumbers& numbers;
    const std::vector<DrawnItem>& items;
  };
  VisiblePoints();
  ~VisiblePoints();

  /// Looks for them: in the keys of the last picture, who won and is not in the plan.
  void choose(const Drawn& drawn, const FramePlan& plan, ThreadCrew& crew);
  /// The same in two steps, where the keys do not stay until the next plan is known: who won is
  /// marked, a bit for each point of the items, which have to stay.
  void mark(const Drawn& drawn, ThreadCrew& crew);
  void chooseMarked(const FramePlan& plan, ThreadCrew& crew);
  /// Forgets what was marked.
  void unmark();
  /// Adds them to the plan's batches, as nodes of their own.
  void addTo(FramePlan& plan) const;
  bool empty() const { return kept_.empty(); }
  std::uint64_t count() const;
  void clear();

private:
  /// Points of one node.
  struct Kept
  {
    std::shared_ptr<const NodeColumns> columns;
    std::vector<std::uint32_t> indices; ///< in the node, ascending
    PlanItem item; ///< how it was drawn
  };
  struct Source;
  struct Place;
  std::vector<Source> sourcesOf(const std::vector<DrawnItem>& drawn) const;
  static bool leaveOutPlanned(const FramePlan& plan, std::vector<Source>& sources);
  static void markVisible(const Drawn& drawn, const std::vector<Source>& sources, ThreadCrew& crew);
  static void markRow(const RasterKey* row, int width, const ItemNumbers& numbers,
    const std::vector<Source>& sources);
  void gather(const std::vector<Source>& sources, ThreadCrew& crew);
  static std::vector<Place> placesOf(const std::vector<const Source*>& parts);
  static std::shared_ptr<const NodeColumns> copied(
    const NodeColumns& model, const std::vector<Place>& places);

  std::vector<Kept> kept_;
  std::vector<Source> marked_;
};

} // namespace pointfront
