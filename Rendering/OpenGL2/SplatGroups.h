#pragma once

#include "DrawRuns.h"
#include "GpuPool.h"
#include "PixelRectangle.h"
#include "RasterItems.h"
#include "SlotRecords.h"

#include "pointfront/Plan/FramePlan.h"

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

namespace pointfront
{

/// What of a plan is on the GPU, in groups that one program draws each, and what of it the last
/// picture has already: a view at rest only gains points (SMOOTH-5).
/// Threads  one thread: that of the GL context.
class SplatGroups
{
public:
  struct Group
  {
    const RasterItems* items;
    const RasterItem* first; ///< as all of it: style, passes
    bool shaped;
    bool sized;
    bool quads; ///< larger than points of GL can be, or far from square
    int mark; ///< GpuStreams; -1: the layer has none
    DrawRuns all;
    DrawRuns added; ///< that the last picture does not have
  };

  SplatGroups();
  ~SplatGroups();

  /// Fills the records of what is drawn and returns its points. `samePicture`: the last picture is
  /// still where it was drawn.
  std::int64_t list(const FramePlan& plan, const GpuPool& pool, float largestPointPx,
    bool samePicture, SlotRecords& records);
  /// The last picture's points are all part of what is listed, as they were.
  bool goesOn() const { return goesOn_; }
  bool addsNothing() const { return addsNothing_; }
  bool blended() const { return blended_; }
  /// What the points can show anything in.
  const PixelRectangle& shown() const { return shown_; }
  const std::vector<Group>& groups() const { return groups_; }

  /// What the last picture has and `plan` lacks, as the plan's camera sees it. What had not its
  /// full size is left out, and so is what a style of the plan does not draw as it was drawn.
  FramePlan leaving(const FramePlan& plan) const;
  /// Of the last picture.
  const FrameCamera& lastCamera() const { return camera_; }
  bool hasLast() const { return !drawn_.empty(); }

  /// What is listed has been drawn; the groups and the plan are no longer used.
  void keep(const FramePlan& plan);
  void forget();

private:
  struct Drawn
  {
    PlanItem item; ///< keeps the node alive: an address is no identity otherwise
    std::shared_ptr<const ResolvedStyle> style;
    TechniquePasses passes;
    std::uint32_t end;
    glm::vec4 radii;
    bool coloured;
    bool shaped;
    bool sized;
  };
  struct Listed
  {
    Group group;
    const GpuPool::Entry* entry;
    SlotRecords::Record record;
    std::uint32_t end;
    std::uint32_t drawnUpTo;

    bool continues(const Drawn& old) const;
  };

  std::int64_t add(const RasterItems& items, const RasterItem& item, const GpuPool& pool,
    float largestPointPx, SlotRecords& records);
  Group& groupOf(const Group& like);
  bool continuesLast(const FramePlan& plan);

  std::vector<std::unique_ptr<RasterItems>> rounds_;
  std::vector<Listed> listed_;
  std::vector<Group> groups_;
  PixelRectangle shown_;
  bool goesOn_ = false;
  bool addsNothing_ = false;
  bool blended_ = false;
  // Of the last picture:
  FrameCamera camera_;
  std::vector<glm::dvec4> clippingPlanes_;
  std::vector<Drawn> drawn_;
};

} // namespace pointfront
