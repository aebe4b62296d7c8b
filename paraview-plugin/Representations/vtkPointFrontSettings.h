/**
 * @class vtkPointFrontSettings
 * @brief what holds for all point clouds of a process: Edit > Settings > PointFront
 *
 * ParaView makes one on the client and on each process of the server and gives all of them the same
 * values, which it keeps in the user's settings. A process has one host memory for the points of
 * all its stores, so each value is set where it belongs at once.
 *
 * Main thread.
 */
#ifndef vtkPointFrontSettings_h
#define vtkPointFrontSettings_h

#include "pointfrontParaViewRepresentationsModule.h" // for the export macro
#include "vtkObject.h"

class POINTFRONTPARAVIEWREPRESENTATIONS_EXPORT vtkPointFrontSettings : public vtkObject
{
public:
  static vtkPointFrontSettings* New();
  vtkTypeMacro(vtkPointFrontSettings, vtkObject);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Of this process, MiB, at least 1 (vtkPointFrontStore::SetProcessMemoryBudget).
   */
  void SetHostMemoryBudget(int mebibytes);
  int GetHostMemoryBudget();
  ///@}

  ///@{
  /**
   * Points that a query or a selection through the cloud may read on this process, at least 1.
   */
  void SetMostSelectionPoints(vtkIdType points);
  vtkIdType GetMostSelectionPoints();
  /// The limit of this process; 50 million until one is set.
  static vtkIdType MostSelectionPoints();
  ///@}

protected:
  vtkPointFrontSettings();
  ~vtkPointFrontSettings() override;

private:
  vtkPointFrontSettings(const vtkPointFrontSettings&) = delete;
  void operator=(const vtkPointFrontSettings&) = delete;
};

#endif
