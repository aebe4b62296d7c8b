#pragma once

#include "SoftwareRasteriser.h"

#include "pointfront/Plan/PlanParts.h"

#include <cstdint>
#include <map>

namespace pointfront
{

/// Pictures of plans that are more than one opaque surface: translucent classes, lenses and
/// highlights. Each part of the plans (PlanParts.h) is drawn into a target of its own, that of a
/// lens is as large as the lens; one pass over the pixels composes them (LAYERS-9, -10). A plan of
/// one part is drawn straight into the target.
/// Depth    a pixel has the depth of its opaque point, or if it has none, of its nearest
///          translucent point. PixelPoint is the nearest point of all.
/// Memory   targets are kept from picture to picture while plans have such parts.
/// Threads  as SoftwareRasteriser.
/// Source   docs/adr/0029.
class SoftwareComposition
{
public:
  /// As SoftwareRasteriser::draw(); called for each store of the picture, one after the other.
  RasterStatistics draw(SoftwareRasteriser& rasteriser, const FramePlan& plan,
    SoftwareTarget& target, std::uint16_t store = 0);
  RasterStatistics drawShown(
    SoftwareRasteriser& rasteriser, const FramePlan& plan, SoftwareTarget& target);
  /// Shades the parts and composes them; called once, after all stores. The next draw() begins
  /// another picture.
  /// `others` as the plan's exchange: the processes that draw the rest of the cloud. Where the
  /// picture is composed of several parts, or its shading looks around a pixel, each of them then
  /// has the picture of all.
  void finish(const FrameCamera& camera, const FrameShading& shading, SoftwareTarget& target,
    PictureExchange* others = nullptr);

private:
  struct Part
  {
    double opacity = 1.0;
    bool begun = false; ///< in this picture
    SoftwareTarget target;
  };
  /// The key of a part: PlanPart without its plan.
  struct PartKey
  {
    std::int16_t lens;
    bool mask;
    std::uint16_t group;
    friend bool operator<(const PartKey& a, const PartKey& b)
    {
      return a.lens != b.lens ? a.lens < b.lens
        : a.mask != b.mask    ? a.mask < b.mask
                              : a.group < b.group;
    }
  };

  SoftwareTarget& begin(const PlanPart& part, const FrameShading& shading,
    const FrameCamera& camera, const SoftwareTarget& whole);
  void blendGroups(std::int16_t lens, SoftwareTarget& target);
  void putLens(std::int16_t number, const FrameCamera& camera, const FrameShading& shading,
    SoftwareTarget& target);

  std::map<PartKey, Part> parts_;
  bool shared_ = false; ///< all processes have the parts of this picture
};

/// Draws highlights: tints the pixels of highlighted points, and draws a rim on what lies behind
/// them.
void highlight(const FrameShading& shading, SoftwareTarget& target);

} // namespace pointfront
