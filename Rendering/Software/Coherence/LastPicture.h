#pragma once

#include "DrawnItem.h"
#include "ItemNumbers.h"
#include "PixelRectangle.h"
#include "RasterBuffers.h"
#include "RasterItems.h"
#include "RasterPieces.h"
#include "VisiblePoints.h"

#include "pointfront/Plan/FramePlan.h"

#include <cstdint>
#include <memory>
#include <utility>
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

  /// The pieces of a picture that are to be drawn.
  struct Pieces
  {
    bool goesOn = false; ///< into the last picture's keys
    std::vector<RasterPiece> there; ///< that are in the keys
    std::vector<RasterPiece> lasting;
    /// Into a copy of the keys, which the next picture does not go on from: points that grow while
    /// a view is refining.
    std::vector<RasterPiece> passing;
    std::uint64_t reused = 0; ///< points that are in the keys
    std::uint64_t drawn = 0; ///< points of the pieces
  };
  /// If the keys are those of the same view: takes the pieces that are not in them yet, gives the
  /// keys the new items' numbers, and makes the window that of the keys. Else all pieces, and also
  /// if the keys' window is not inside of `most`.
  Pieces begin(
    const RasterItems& items, RasterWindow& window, ThreadCrew& crew, const PixelRectangle& most);

  /// The keys' memory, for the next picture to be drawn into.
  RasterBuffer<RasterKey> takeKeys();
  bool hasKeys() const { return keys_.data() != nullptr; }
  /// The sums that belong to the keys, if there are any.
  BlendedSums takeSums() { return std::move(sums_); }
  /// Pixels of the picture that is kept.
  std::int64_t keyPixels() const { return hasKeys() ? window_.pixels() : 0; }
  /// Keeps all that was drawn of a view.
  void keep(const RasterItems& items, const RasterWindow& window, RasterBuffer<RasterKey> keys,
    BlendedSums sums);
  /// The same, but that the keys do not stay.
  void keepVisible(
    const RasterItems& items, const RasterWindow& window, const RasterKey* keys, ThreadCrew& crew);
  /// It was a part of a view only.
  void forget();

private:
  VisiblePoints::Drawn drawn(const RasterKey* keys) const;
  bool isOf(const FramePlan& plan) const;
  bool goOn(const RasterItems& items, RasterWindow& window, ThreadCrew& crew,
    std::vector<std::uint32_t>& drawnUpTo);
  void note(const RasterItems& items, const RasterWindow& window);
  bool renumber(const RasterItems& items, ThreadCrew& crew, std::vector<std::uint32_t>& drawnUpTo);

  bool known_ = false; ///< all that was drawn of a view is known
  bool valid_ = false; ///< and its keys are here
  RasterBuffer<RasterKey> keys_;
  BlendedSums sums_;
  FrameCamera camera_;
  std::vector<glm::dvec4> clippingPlanes_;
  RasterWindow window_;
  std::vector<DrawnItem> items_;
  std::vector<std::uint32_t> lastingUpTo_; ///< for each item of the picture that was begun
  ItemNumbers numbers_;
  std::vector<std::shared_ptr<const ResolvedStyle>> styles_; ///< alive, as the nodes
  QuantisationGrid grid_;
  std::shared_ptr<const AttributeSchema> schema_;
  VisiblePoints visible_;
};

} // namespace pointfront
