#pragma once

#include "RasterBuffers.h"
#include "RasterItems.h"
#include "SoftwareTarget.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// From keys and sums to the picture: attributes are fetched for the points that are seen only.
/// Threads  one object a thread; rows are independent.
class WinnerResolve
{
public:
  struct Source
  {
    const RasterKernels* kernels = nullptr;
    const RasterItems* items = nullptr;
    RasterWindow window;
    std::vector<const RasterKey*> keys; ///< of all threads; the first takes the smallest of all
    RasterKey* merged = nullptr;
    std::vector<const std::uint32_t*> sums; ///< of those that drew any
    std::uint16_t store = 0;
    bool normals = false; ///< the target has them
  };

  WinnerResolve(const Source& source, RasterBatch& batch)
    : source_(source)
    , batch_(batch)
  {
  }
  /// One row of the window into the target's row `targetRow`.
  void row(int y, SoftwareTarget& target, int targetRow);

private:
  struct Winner
  {
    std::int32_t x;
    std::uint32_t index; ///< in its node
    float keyDepth;
  };
  void take(int y, int x, RasterKey key, SoftwareTarget& target, int targetRow);
  void flush(int y, SoftwareTarget& target, int targetRow);
  void put(const RasterItem& item, const Winner& winner, float depth, int y,
    SoftwareTarget& target, std::size_t pixel);
  bool blendedColour(int y, int x, std::uint32_t& rgba) const;
  float planeDepth(const RasterItem& item, int j, int x, int y) const;
  void putNormal(const RasterItem& item, int j, int x, int y, float depth, float* normal) const;

  const Source& source_;
  RasterBatch& batch_;
  const RasterItem* item_ = nullptr; ///< of the winners that wait
  std::vector<Winner> waiting_;
};

} // namespace pointfront
