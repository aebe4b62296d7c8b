#include "WorldMarks.h"

#include <vtkCallbackCommand.h>
#include <vtkCamera.h>
#include <vtkCellArray.h>
#include <vtkCommand.h>
#include <vtkCoordinate.h>
#include <vtkPoints.h>
#include <vtkPolyDataMapper2D.h>
#include <vtkProperty2D.h>
#include <vtkRenderer.h>

#include <glm/geometric.hpp>

#include <utility>

namespace pointfront
{

WorldMarks::WorldMarks(vtkRenderer* renderer)
  : renderer_(renderer)
{
  vtkNew<vtkCoordinate> world;
  world->SetCoordinateSystemToWorld();
  vtkNew<vtkPolyDataMapper2D> mapper;
  mapper->SetInputData(shapes_);
  mapper->SetTransformCoordinate(world); // in double precision
  actor_->SetMapper(mapper);
  actor_->GetProperty()->SetColor(1.0, 0.85, 0.1);
  actor_->GetProperty()->SetLineWidth(2.0f);
  actor_->GetProperty()->SetPointSize(9.0f);
  actor_->PickableOff();
  actor_->VisibilityOff();
  renderer_->AddViewProp(actor_);
  command_->SetClientData(this);
  command_->SetCallback([](vtkObject*, unsigned long, void* self, void*)
    { static_cast<WorldMarks*>(self)->project(); });
  renderer_->AddObserver(vtkCommand::StartEvent, command_);
}

WorldMarks::~WorldMarks()
{
  renderer_->RemoveObserver(command_);
}

void WorldMarks::set(std::vector<glm::dvec3> places)
{
  places_ = std::move(places);
  actor_->SetVisibility(places_.empty() ? 0 : 1);
  project();
}

/// Points behind the eye would be drawn in front of it: lines end at the clipping plane.
void WorldMarks::project()
{
  if (places_.empty())
  {
    return;
  }
  vtkCamera* const camera = renderer_->GetActiveCamera();
  const double* const eye = camera->GetPosition();
  const double* const sight = camera->GetDirectionOfProjection();
  const double nearest = camera->GetClippingRange()[0];
  const auto depthOf = [&](const glm::dvec3& p)
  {
    return glm::dot(
             p - glm::dvec3(eye[0], eye[1], eye[2]), glm::dvec3(sight[0], sight[1], sight[2])) -
      nearest;
  };
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkCellArray> marks;
  vtkNew<vtkCellArray> lines;
  const auto insert = [&points](const glm::dvec3& p) { return points->InsertNextPoint(&p.x); };
  for (std::size_t i = 0; i < places_.size(); ++i)
  {
    const double depth = depthOf(places_[i]);
    if (depth > 0.0)
    {
      const vtkIdType mark = insert(places_[i]);
      marks->InsertNextCell(1, &mark);
    }
    const double before = i > 0 ? depthOf(places_[i - 1]) : 0.0;
    if (i == 0 || (depth <= 0.0 && before <= 0.0))
    {
      continue;
    }
    const auto shown = [&](const glm::dvec3& p, double own, const glm::dvec3& q, double other)
    { return own > 0.0 ? p : p + (q - p) * (own / (own - other)); };
    const vtkIdType ends[2] = { insert(shown(places_[i - 1], before, places_[i], depth)),
      insert(shown(places_[i], depth, places_[i - 1], before)) };
    lines->InsertNextCell(2, ends);
  }
  shapes_->SetPoints(points);
  shapes_->SetVerts(marks);
  shapes_->SetLines(lines);
}

} // namespace pointfront
