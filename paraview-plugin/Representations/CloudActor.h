#pragma once

#include "vtkBoundingBox.h"
#include "vtkPVLODActor.h"

class vtkRenderer;

namespace pointfront
{

/// The actor of a cloud. Points are drawn around their places, by half their size beyond the box
/// of the cloud, and IceT, which composites the pictures of ranks, cuts off what lies outside of
/// the actors' boxes. So the actor's box may be said to cover a view.
/// Threads  main thread.
class CloudActor final : public vtkPVLODActor
{
public:
  static CloudActor* New();
  vtkTypeMacro(CloudActor, vtkPVLODActor);

  /// The box of the points, or with a covered view the box around both.
  double* GetBounds() override;
  /// The box of the points' places, in world coordinates. Uninitialized without points.
  double* GetCloudBounds() { return this->Superclass::GetBounds(); }

  /// From now on the actor's box holds all that the renderer's camera sees, if the cloud lies in
  /// the view or close to it; null: it holds the points' places only.
  void CoverView(vtkRenderer* renderer);

private:
  vtkBoundingBox view_;
  double covered_[6]{};
};

} // namespace pointfront
