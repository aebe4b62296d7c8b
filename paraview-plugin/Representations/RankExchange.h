#pragma once

#include "pointfront/Plan/PictureExchange.h"

class vtkMultiProcessController;
class vtkRenderer;

namespace pointfront
{

/// Whether the box is in that view for sure: a part of it lies in the view, and not just at an
/// edge. Who culls by bounds then draws what is in the box.
bool isSurelyInView(vtkRenderer* renderer, const double bounds[6]);

/// The ranks of a server, as they draw a picture together.
class RankExchange final : public PictureExchange
{
public:
  /// Whether all ranks would exchange their sums in this frame: each calls it once a frame,
  /// whatever it wants itself. On a single one: false.
  bool agreed(vtkMultiProcessController* ranks, bool wanted);

  bool nearest(float* depths, std::size_t count) override;
  void sum(std::uint32_t* sums, std::size_t count) override;

private:
  vtkMultiProcessController* ranks_ = nullptr;
};

} // namespace pointfront
