#pragma once

#include "pointfront/Views/HierarchyPiece.h"
#include "pointfront/Views/WholeFront.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

namespace pointfront
{

/// The nodes that other pieces of a hierarchy draw of a view, from the table alone. The other
/// pieces draw these nodes as soon as they have loaded what they want at that threshold.
/// Time     as WholeFront's.
/// Threads  one.
class OtherPieces
{
public:
  using Drawn = TabledNode;

  explicit OtherPieces(std::shared_ptr<const HierarchyPiece> piece);
  ~OtherPieces();

  /// As WholeFront::update().
  void update(const View& view, const FrontLimits& limits, double thresholdPx,
    const std::function<bool()>& waits);
  /// By node.
  const std::vector<Drawn>& drawn() const { return drawn_; }

private:
  std::shared_ptr<const HierarchyPiece> piece_;
  WholeFront front_;
  std::uint64_t seen_ = 0; ///< number of the delta that drawn_ is made of
  std::vector<Drawn> drawn_;
};

} // namespace pointfront
