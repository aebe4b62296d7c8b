#pragma once

#include "DrawnItem.h"
#include "ItemNumbers.h"
#include "KeptPoints.h"
#include "RasterBatch.h"

#include "pointfront/Plan/FramePlan.h"

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

namespace pointfront
{
class ThreadCrew;

/// Points that pictures of a motion showed, kept as long as the motion lasts: they were visible and
/// that the next plan does not draw, at most as many as there are pixels. They are copied together,
/// so that the nodes they come from may leave the memory (SMOOTH-7).
/// Threads  one thread at a time; works with those of a crew.
class VisiblePoints
{
public:
  /// The keys of the last picture, and the meaning of their indices, an item each.
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
  /// Adds those that the chosen plan lacks to its batches, as nodes of their own.
  void addTo(FramePlan& plan) const;
  bool empty() const { return count() == 0; }
  /// Number of points that are added to a plan.
  std::uint64_t count() const;
  void clear();

private:
  struct Source;
  using Prefixes = std::unordered_map<NodeIndex, std::uint32_t>;
  using Parts = std::vector<const Source*>;
  std::vector<Source> sourcesOf(const std::vector<DrawnItem>& drawn) const;
  static bool leaveOutPlanned(
    const FramePlan& plan, const Prefixes& prefixes, std::vector<Source>& sources);
  static void markVisible(const Drawn& drawn, const std::vector<Source>& sources, ThreadCrew& crew);
  static void markRow(const RasterKey* row, int width, const ItemNumbers& numbers,
    const std::vector<Source>& sources);
  void gather(const std::vector<Source>& sources, const FramePlan& plan, ThreadCrew& crew);
  void update(KeptNode& kept, const Parts& parts) const;
  void leaveOutPlanned(const FramePlan& plan, const Prefixes& prefixes);

  KeptNodes kept_;
  std::vector<Source> marked_;
  std::uint32_t frame_ = 0; ///< number of the motion's frame
};

} // namespace pointfront
