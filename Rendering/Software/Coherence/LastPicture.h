#pragma once

#include "DrawnItem.h"
#include "ItemNumbers.h"
#include "RasterBuffers.h"
#include "RasterItems.h"
#include "RasterPieces.h"
#include "VisiblePoints.h"

#include "pointfront/Plan/FramePlan.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{
class ThreadCrew;

/// The state of a store's last picture, which the next picture continues: its keys, if there is
/// memory for them; the meaning of the keys; the visible points, for views that move.
/// Threads  one thread at a time; works with those of a crew.
class LastPicture
{
public:
  /// The visible points of the last picture that a plan draws in addition to its own, if it asks
  /// for them (FramePlan::keepsVisible).
  const VisiblePoints& visibleFor(const FramePlan& plan, bool wanted, ThreadCrew& crew);

  /// If the keys are those of the same view: takes the pieces that are not in them yet, gives the
  /// keys the new items' numbers, adds to `reused` the points that are there, and makes the window
  /// that of the keys.
  bool goOn(const RasterItems& items, RasterWindow& window, ThreadCrew& crew,
    std::vector<RasterPiece>& pieces, std::uint64_t& reused);

  /// The keys' memory, for the next picture to be drawn into.
  RasterBuffer<RasterKey> takeKeys();
  bool hasKeys() const { return keys_.data() != nullptr; }
  /// Of a picture that is kept.
  std::int64_t keyPixels() const { return hasKeys() ? window_.pixels() : 0; }
  /// What was drawn, all of a view.
  void keep(const RasterItems& items, const RasterWindow& window, RasterBuffer<RasterKey> keys);
  /// The same, but that the keys do not stay.
  void keepVisible(
    const RasterItems& items, const RasterWindow& window, const RasterKey* keys, ThreadCrew& crew);
  /// It was a part of a view only.
  void forget();

private:
  VisiblePoints::Drawn drawn(const RasterKey* keys) const;
  bool isOf(const FramePlan& plan) const;
  void note(const RasterItems& items, const RasterWindow& window);
  bool renumber(const RasterItems& items, ThreadCrew& crew, std::vector<std::uint32_t>& drawnUpTo);

  bool known_ = false; ///< what was drawn, all of a view
  bool valid_ = false; ///< and its keys are here
  RasterBuffer<RasterKey> keys_;
  FrameCamera camera_;
  std::vector<glm::dvec4> clippingPlanes_;
  RasterWindow window_;
  std::vector<DrawnItem> items_;
  ItemNumbers numbers_;
  std::vector<std::shared_ptr<const ResolvedStyle>> styles_; ///< alive, as the nodes
  QuantisationGrid grid_;
  std::shared_ptr<const AttributeSchema> schema_;
  VisiblePoints visible_;
};

} // namespace pointfront
