#pragma once

#include <vtkActor2D.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <glm/vec3.hpp>

#include <vector>

class vtkCallbackCommand;
class vtkRenderer;

namespace pointfront
{

/// Marks at places of the world and a line through them, over the picture: points do not hide them.
class WorldMarks
{
public:
  explicit WorldMarks(vtkRenderer* renderer);
  ~WorldMarks();
  WorldMarks(const WorldMarks&) = delete;
  WorldMarks& operator=(const WorldMarks&) = delete;

  /// None: nothing is shown.
  void set(std::vector<glm::dvec3> places);

private:
  void project();

  vtkRenderer* renderer_;
  vtkNew<vtkCallbackCommand> command_;
  vtkNew<vtkPolyData> shapes_;
  vtkNew<vtkActor2D> actor_;
  std::vector<glm::dvec3> places_;
};

} // namespace pointfront
