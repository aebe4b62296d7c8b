#pragma once

#include "pointfront/Front/DetailSelection.h"
#include "pointfront/Views/HierarchyPiece.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace pointfront
{

/// The nodes that other pieces of a hierarchy draw of a view, from the table alone: a front over
/// the whole hierarchy, as if all of it were in memory. The other pieces draw these nodes as soon
/// as they have loaded what they want at that threshold.
/// Time     that of a front's update; next to nothing where neither view nor threshold changed.
/// Threads  one.
class OtherPieces
{
public:
  struct Drawn
  {
    DrawItem item;
    Node row;
  };

  explicit OtherPieces(std::shared_ptr<const HierarchyPiece> piece);
  ~OtherPieces();

  /// Updates for a view with the layers of `limits`, at a threshold. `waits`: as long as it is true
  /// the update waits for rows of a paged table; empty: the next update looks again for rows that
  /// are on their way.
  void update(const View& view, const FrontLimits& limits, double thresholdPx,
    const std::function<bool()>& waits);
  /// By node.
  const std::vector<Drawn>& drawn() const { return drawn_; }

private:
  class AllResident;
  std::shared_ptr<const HierarchyPiece> piece_;
  std::unique_ptr<AllResident> residents_;
  std::unique_ptr<DetailSelection> front_;
  std::uint64_t seen_ = 0; ///< number of the delta that drawn_ is made of
  std::vector<Drawn> drawn_;
};

} // namespace pointfront
