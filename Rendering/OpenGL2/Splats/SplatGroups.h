#pragma once

#include "DrawRuns.h"
#include "GpuPool.h"
#include "PixelRectangle.h"
#include "RasterItems.h"
#include "SlotRecords.h"

#include "pointfront/Plan/FramePlan.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace pointfront
{

/// The points of a plan that are on the GPU, in groups that one program draws each; and those of
/// them that the last picture already has, because a view at rest only gains points (SMOOTH-5).
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
    DrawRuns all; ///< but what grows apart
    DrawRuns added; ///< those of them that the last picture does not have
    DrawRuns growing; ///< apart from the others
  };

  SplatGroups();
  ~SplatGroups();

  /// Fills the records of the drawn nodes and returns the number of their points. `samePicture`:
  /// the last picture is still in its target. `growsApart`: points that have not grown to their
  /// size are no part of the picture that the next one goes on from.
  std::int64_t list(const FramePlan& plan, const GpuPool& pool, float largestPointPx,
    bool samePicture, SlotRecords& records, bool growsApart = false);
  /// Whether the list contains all points of the last picture, unchanged.
  bool goesOn() const { return goesOn_; }
  bool addsNothing() const { return addsNothing_; }
  /// Whether points grow apart.
  bool grows() const { return grows_; }
  bool blended() const { return blended_; }
  /// The rectangle in which the points can show anything.
  const PixelRectangle& shown() const { return shown_; }
  const std::vector<Group>& groups() const { return groups_; }
  /// Calls with each item of the list, in the order of the nodes.
  void forEach(const std::function<void(const RasterItem&, const GpuPool::Entry&)>& visit) const;

  /// Points of the last picture that `plan` lacks, as the plan's camera sees them. Points that had
  /// not grown to their size are left out, and so are those that no style of the plan draws as they
  /// were drawn.
  FramePlan leaving(const FramePlan& plan) const;
  /// The camera of the last picture.
  const FrameCamera& lastCamera() const { return camera_; }

  /// Tells that the list has been drawn; the groups and the plan are no longer used.
  void keep(const FramePlan& plan);
  void forget();

private:
  struct Drawn
  {
    PlanItem item; ///< keeps the node alive: an address is no identity otherwise
    std::shared_ptr<const ResolvedStyle> style;
    TechniquePasses passes;
    std::uint32_t end;
    SizeTerms size;
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
    std::uint32_t end; ///< from list() on: of those that do not grow apart
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
  bool grows_ = false;
  bool blended_ = false;
  // State of the last picture:
  FrameCamera camera_;
  std::vector<glm::dvec4> clippingPlanes_;
  std::vector<Drawn> drawn_;
};

} // namespace pointfront
