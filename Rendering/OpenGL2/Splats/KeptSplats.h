#pragma once

#include "SplatFrame.h"
#include "SplatGroups.h"
#include "SplatTarget.h"

#include "pointfront/Plan/FrameCamera.h"

#include <glm/mat4x4.hpp>

#include <cstdint>
#include <memory>
#include <vector>

class vtkShaderProgram;
class vtkTextureObject;

namespace pointfront
{

/// Splats of the last picture that the next plan lacks, on the GPU (SMOOTH-7): those whose centre's
/// pixel shows them, at most one a pixel. Transform feedback copies them before the memory of their
/// nodes goes to others. Each frame of a motion captures them anew, as floats in the camera space
/// of that frame: the error of a frame is 1e-7 of the depth.
/// Bytes    52 a point, not part of the GPU budget.
/// Threads  the thread of the GL context, which is current in all functions but the constructor.
/// Source   docs/adr/0028. Twin of VisiblePoints.
class KeptSplats
{
public:
  /// What the last picture says.
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

  /// Looks through what is kept and through `leaving`, points of the last picture that are listed
  /// as the frame's camera sees them, with `records` of their slots; keeps what was seen.
  void collect(const SplatFrame& frame, SplatTools& tools, const SplatGroups& leaving,
    const FramePlan& plan, const LastPicture& last);
  /// Draws them as the plan's groups of the same style are drawn.
  void draw(const SplatFrame& frame, SplatTools& tools, const SplatGroups& groups,
    const SplatTarget::Parts& parts, bool second, vtkTextureObject* seenDepths);
  /// Gives the buffers back.
  void clear();

private:
  /// Of one style.
  struct Set
  {
    std::shared_ptr<const ResolvedStyle> style;
    RadiusSource radius = RadiusSource::Node; ///< what splats of this style have
    bool quads = false;
    std::uint32_t buffer = 0; ///< GL's name
    std::int64_t points = 0;
    std::uint32_t query = 0; ///< of the points, while these are being captured
  };
  static SplatVariant variantOfKept(const Set& set, bool parallel);
  static void setLast(vtkShaderProgram* program, const FramePlan& plan, const LastPicture& last);
  void collectGroup(const SplatFrame& frame, SplatTools& tools, const SplatGroups::Group& group,
    const FramePlan& plan, const LastPicture& last);
  void collectKept(const SplatFrame& frame, SplatTools& tools, const std::vector<Set>& kept,
    const Set& model, const FramePlan& plan, const LastPicture& last);
  void setPlaces(vtkShaderProgram* program, const FrameCamera& now) const;
  static bool begin(Set& set, std::int64_t most);
  static void end();

  std::vector<Set> sets_;
  FrameCamera camera_; ///< whose space they are in
};

} // namespace pointfront
