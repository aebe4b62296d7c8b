#pragma once

#include "Scene.h"

#include <algorithm>
#include <string>
#include <vector>

namespace pointfront::test
{

/// Hills beside each other, seen together from above; one mapper each.
struct Clouds
{
  explicit Clouds(int count)
    : first(store(0))
  {
    first.mapper->SetTargetError(0.02);
    for (int c = 1; c < count; ++c)
    {
      add(c);
    }
    first.lookFrom({ 0.0, 0.0, 40.0 }, { 0.0, 0.0, 0.0 });
  }
  static std::string store(int number)
  {
    const double x = 3.0 * (number % 4) - 6.0;
    const double y = 3.0 * (number / 4) - 3.0;
    return builtStore(
      "cloud" + std::to_string(number), hills(40000, 3000.0, millimetres({ x, y, 0.0 })));
  }
  void add(int number)
  {
    readers.push_back(vtkSmartPointer<vtkPointFrontReader>::New());
    readers.back()->SetFileName(store(number).c_str());
    mappers.push_back(vtkSmartPointer<vtkPointFrontMapper>::New());
    mappers.back()->SetInputConnection(readers.back()->GetOutputPort());
    mappers.back()->SetBackendToOpenGL();
    mappers.back()->CompleteOn();
    mappers.back()->SetTargetError(0.02);
    actors.push_back(vtkSmartPointer<vtkActor>::New());
    actors.back()->SetMapper(mappers.back());
    first.renderer->AddActor(actors.back());
  }
  std::vector<vtkPointFrontMapper*> all() const
  {
    std::vector<vtkPointFrontMapper*> list{ first.mapper };
    list.insert(list.end(), mappers.begin(), mappers.end());
    return list;
  }
  void setPointBudget(vtkIdType points) const
  {
    for (vtkPointFrontMapper* mapper : all())
    {
      mapper->SetPointBudget(points);
    }
  }
  void setGpuBudget(vtkTypeInt64 bytes)
  {
    gpuBudget = bytes;
    for (vtkPointFrontMapper* mapper : all())
    {
      mapper->SetGPUMemoryBudget(bytes);
    }
  }
  /// Frames until nobody wants another one, each within the budget of GPU memory.
  void settle()
  {
    int frames = 0;
    bool again = true;
    while (again && ++frames < 200)
    {
      first.window->Render();
      if (gpuBudget > 0)
      {
        EXPECT_LE(gpuBytes(), gpuBudget) << "frame " << frames;
      }
      again = false;
      for (vtkPointFrontMapper* mapper : all())
      {
        again = again || mapper->NeedsRender();
      }
    }
    EXPECT_LT(frames, 200);
  }
  vtkIdType drawn() const
  {
    vtkIdType sum = 0;
    for (vtkPointFrontMapper* mapper : all())
    {
      sum += mapper->GetLastPointsDrawn();
    }
    return sum;
  }
  /// The most that there was of all of them while they were drawn.
  vtkTypeInt64 gpuBytes() const
  {
    vtkTypeInt64 most = 0;
    for (vtkPointFrontMapper* mapper : all())
    {
      most = std::max(most, mapper->GetLastWindowGPUBytes());
    }
    return most;
  }
  /// Largest threshold over smallest.
  double spread() const
  {
    double least = 1e30;
    double most = 0.0;
    for (vtkPointFrontMapper* mapper : all())
    {
      least = std::min(least, mapper->GetLastThreshold());
      most = std::max(most, mapper->GetLastThreshold());
    }
    return most / least;
  }

  Scene first;
  std::vector<vtkSmartPointer<vtkPointFrontReader>> readers;
  std::vector<vtkSmartPointer<vtkPointFrontMapper>> mappers;
  std::vector<vtkSmartPointer<vtkActor>> actors;
  vtkTypeInt64 gpuBudget = 0;
};

} // namespace pointfront::test
