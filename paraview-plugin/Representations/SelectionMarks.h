#pragma once

#include "vtkWeakPointer.h"

#include <vector>

class vtkPVLODActor;
class vtkRenderer;

namespace pointfront
{

/// The actors of a view that cannot be picked: above all the marks of what is selected, which hide
/// what is to be deselected.
/// Threads  main thread.
class SelectionMarks
{
public:
  /// Out of the renderer, not invisible: who made them goes on updating them and decides whether
  /// they are shown.
  void takeOut(vtkRenderer* renderer);
  void putBack(vtkRenderer* renderer);

private:
  std::vector<vtkWeakPointer<vtkPVLODActor>> out_;
};

} // namespace pointfront
