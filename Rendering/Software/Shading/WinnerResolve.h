#pragma once

#include "RasterBuffers.h"
#include "RasterItems.h"
#include "SoftwareTarget.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// From keys and sums to the picture: attributes are fetched for the points that are seen only.
/// Winners of a few thousand pixels are found first, while the memory that holds their attributes
/// is fetched ahead; then they are worked on node by node.
/// Threads  one object a thread; rows are independent.
class WinnerResolve
{
public:
  struct Source
  {
    const RasterKernels* kernels = nullptr;
    const RasterItems* items = nullptr;
    RasterWindow window;
    std::vector<const RasterKey*> keys; ///< from all threads; the first takes the smallest of all
    RasterKey* merged = nullptr;
    std::vector<const std::uint32_t*> sums; ///< sums of the threads that drew any
    std::uint16_t store = 0;
    bool normals = false; ///< the target has them
    bool standIns = false; ///< stand-ins are shown only far in front of the target's pixels
  };

  WinnerResolve(const Source& source, ThreadBuffers& buffers)
    : source_(source)
    , batch_(buffers.scratch())
    , winners_(buffers.winners)
  {
  }
  /// Rows [begin, end) of the window, which lies in the target's rectangle.
  void rows(int begin, int end, SoftwareTarget& target);

private:
  void merge(int y);
  void find(int y);
  void resolveFound(SoftwareTarget& target);
  void sortByItem();
  void resolve(const RasterItem& item, const Winner* winners, int count, SoftwareTarget& target);
  bool put(const RasterItem& item, int j, const Winner& winner, float depth, SoftwareTarget& target,
    std::size_t pixel);
  std::uint32_t colourOf(const RasterItem& item, int j, const Winner& winner, float depth) const;
  glm::vec3 fromCentre(const RasterItem& item, int j, const Winner& winner, float depth) const;
  bool blendedColour(const Winner& winner, std::uint32_t& rgba) const;
  float planeDepth(const RasterItem& item, int j, const Winner& winner) const;
  void putNormal(
    const RasterItem& item, int j, const Winner& winner, float depth, float* normal) const;

  const Source& source_;
  RasterBatch& batch_;
  WinnerLists& winners_;
};

} // namespace pointfront
