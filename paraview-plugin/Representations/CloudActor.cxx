#include "CloudActor.h"

#include "RankExchange.h"

#include "vtkCamera.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkRenderer.h"

namespace pointfront
{
namespace
{

/// Half of a view's sides, in clip coordinates; the rest is for rounding.
constexpr double side = 1.01;
/// A cloud that is nearer to the view than this share of its box's diagonal may reach into it:
/// splats are smaller.
constexpr double nearby = 0.1;

/// The box of all that the camera sees.
vtkBoundingBox boxOf(vtkRenderer* renderer)
{
  vtkMatrix4x4* const toClip = renderer->GetActiveCamera()->GetCompositeProjectionTransformMatrix(
    renderer->GetTiledAspectRatio(), -1.0, 1.0);
  vtkNew<vtkMatrix4x4> toWorld;
  vtkMatrix4x4::Invert(toClip, toWorld);
  vtkBoundingBox box;
  for (const double x : { -side, side })
  {
    for (const double y : { -side, side })
    {
      for (const double z : { -1.0, 1.0 })
      {
        const double clip[4] = { x, y, z, 1.0 };
        double world[4];
        toWorld->MultiplyPoint(clip, world);
        box.AddPoint(world[0] / world[3], world[1] / world[3], world[2] / world[3]);
      }
    }
  }
  return box;
}

} // namespace

vtkStandardNewMacro(CloudActor);

double* CloudActor::GetBounds()
{
  double* const places = this->GetCloudBounds();
  if (!view_.IsValid() || !places || !vtkBoundingBox(places).IsValid())
  {
    return places;
  }
  vtkBoundingBox both = view_;
  both.AddBounds(places);
  both.GetBounds(covered_);
  return covered_;
}

void CloudActor::CoverView(vtkRenderer* renderer)
{
  view_.Reset();
  const double* const places = renderer ? this->GetCloudBounds() : nullptr;
  vtkBoundingBox around;
  places ? around.SetBounds(places) : void();
  if (!around.IsValid())
  {
    return;
  }
  around.Inflate(nearby * around.GetDiagonalLength());
  double bounds[6];
  around.GetBounds(bounds);
  if (isSurelyInView(renderer, bounds))
  {
    view_ = boxOf(renderer);
  }
}

} // namespace pointfront
