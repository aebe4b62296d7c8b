#pragma once

#include "SplatFrame.h"
#include "SplatGroups.h"
#include "SplatTarget.h"

#include "pointfront/Plan/FrameCamera.h"

#include <glm/mat4x4.hpp>

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

class vtkShaderProgram;
class vtkTextureObject;

namespace pointfront
{

/// Splats that pictures of a motion showed and the next plan lacks, on the GPU (SMOOTH-7): those
/// whose centre's pixel shows them, at most one a pixel. Transform feedback copies them before the
/// memory of their nodes goes to others, as floats in the camera space of that frame: the error is
/// 1e-7 of the depth. They stay as long as the motion lasts, though others hide them for a while.
/// Where they are more than pixels, those go that the last picture does not show.
/// Bytes    52 a point, not part of the GPU budget.
/// Threads  the thread of the GL context, which is current in all functions but the constructor.
/// Source   docs/adr/0028. Twin of VisiblePoints.
class KeptSplats
{
public:
  /// Facts of the last picture.
  struct LastPicture
  {
    const FrameCamera& camera;
    vtkTextureObject* ids;
  };

  KeptSplats() = default;
  ~KeptSplats();
  KeptSplats(const KeptSplats&) = delete;
  KeptSplats& operator=(const KeptSplats&) = delete;

  bool empty() const { return sets_.empty(); }
  std::int64_t points() const;

  /// Leaves out of `leaving` (SplatGroups::leaving) what was looked through before in this motion,
  /// and notes the rest.
  void leaveOutKnown(FramePlan& leaving);
  /// Looks through `leaving`, points of the last picture that are listed as the frame's camera sees
  /// them, with tools.lastRecords of their slots; adds what was seen. What the plan draws in
  /// another style goes.
  void collect(const SplatFrame& frame, SplatTools& tools, const SplatGroups& leaving,
    const FramePlan& plan, const LastPicture& last);
  /// Draws them as the plan's groups of the same style are drawn.
  void draw(const SplatFrame& frame, SplatTools& tools, const SplatGroups& groups,
    const SplatTarget::Parts& parts, bool second, vtkTextureObject* seenDepths);
  /// Gives the buffers back.
  void clear();

private:
  /// The points of one style.
  struct Set
  {
    std::shared_ptr<const ResolvedStyle> style;
    RadiusSource radius = RadiusSource::Node; ///< source of the radii of this style's splats
    bool quads = false;
    std::uint32_t buffer = 0; ///< GL's name
    std::int64_t points = 0;
    std::uint32_t query = 0; ///< query of the points, while these are being captured
    FrameCamera camera; ///< whose space they are in
  };
  /// The range of a node's points that was looked through.
  struct Range
  {
    std::uint32_t first;
    std::uint32_t last;
  };
  static SplatVariant variantOfKept(const Set& set, bool parallel);
  static void setLast(vtkShaderProgram* program, const FramePlan& plan, const LastPicture& last);
  void collectGroup(const SplatFrame& frame, SplatTools& tools, const SplatGroups::Group& group,
    const FramePlan& plan, const LastPicture& last);
  void adopt(const FramePlan& plan);
  /// All sets of one style become one; `all`: with those that the last picture does not show.
  void gather(const SplatFrame& frame, SplatTools& tools, const FramePlan& plan,
    const LastPicture& last, bool all);
  Set gathered(const SplatFrame& frame, SplatTools& tools, const std::vector<Set>& kept,
    const FramePlan& plan, const LastPicture& last, bool all) const;
  static void setPlaces(vtkShaderProgram* program, const Set& set, const FrameCamera& now);
  static bool begin(Set& set, std::int64_t most);
  static void end();
  static void count(Set& set);
  void dropEmpty();

  std::vector<Set> sets_;
  std::unordered_map<NodeIndex, Range> known_;
};

} // namespace pointfront
