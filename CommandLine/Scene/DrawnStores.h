#pragma once

#include "DrawnStore.h"
#include "FrameRecord.h"
#include "StoreScene.h"

#include "pointfront/Base/Bounds.h"
#include "pointfront/Style/StyleSheet.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// The stores of one view that is drawn without VTK, in one window: one scheduler loads them, and
/// they share the window's budgets.
/// Threads  one thread.
class DrawnStores
{
public:
  /// Opens the stores and resolves the style for each. The colour that the sheet does not name is
  /// the first store's, for all.
  /// Errors  those of the stores; a style that a store cannot follow; no class that is shown.
  Result<void> open(const std::vector<std::string>& paths, StyleSheet sheet);

  std::size_t count() const { return stores_.size(); }
  DrawnStore& operator[](std::size_t number) { return *stores_[number]; }
  const DrawnStore& operator[](std::size_t number) const { return *stores_[number]; }
  const DrawnStore& first() const { return *stores_.front(); }
  const Bounds& bounds() const { return bounds_; }
  std::vector<std::string> warnings() const;
  /// Visits each style that draws anything.
  template <typename Visit>
  void forEachStyle(const Visit& visit) const
  {
    for (const auto& store : stores_)
    {
      for (const LayerStyling& layer : store->styles())
      {
        std::for_each(
          layer.styles.begin(), layer.styles.end(), [&visit](const auto& style) { visit(*style); });
      }
    }
  }

  /// Moves all fronts towards a view; where `common.complete`, until stores that share a budget
  /// have come to one error. Gives the milliseconds that each front took.
  std::vector<double> update(
    const FrameRequest& common, const FrameCamera& camera, const FrameShading& shading);
  /// A record of the fronts after update(), before anything is drawn.
  FrameRecord record() const;
  /// The first fault since the last call.
  Result<void> outcome();

  /// Whether a frame is due for any store. Cheap; moves the fronts.
  bool needsFrame();
  /// Waits until a frame is due; false where nothing is loading any more.
  bool waitForArrival();
  /// Whether anything is on its way from the disk.
  bool loads() const;
  std::vector<std::string> attributesRead() const;
  LoadScheduler& scheduler() const { return first().residency().scheduler(); }
  LoadingRecord loading() const;

private:
  Result<void> resolve(StyleSheet sheet);

  std::vector<std::unique_ptr<DrawnStore>> stores_;
  Bounds bounds_;
  std::uint64_t allPoints_ = 0; ///< number of points in all stores
  std::string lightDoubt_;
};

} // namespace pointfront
