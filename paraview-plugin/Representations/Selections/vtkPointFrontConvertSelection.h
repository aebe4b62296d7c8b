/**
 * @class vtkPointFrontConvertSelection
 * @brief ParaView's conversion of selections, which keeps points of a store named by their ids
 *
 * ParaView converts a selection into row numbers when it freezes one. Most points of a store
 * are in no row of the reader's output, so a selection that names them stays as it is.
 */
#ifndef vtkPointFrontConvertSelection_h
#define vtkPointFrontConvertSelection_h

#include "pointfrontParaViewRepresentationsModule.h" // for the export macro
#include "vtkPConvertSelection.h"

class POINTFRONTPARAVIEWREPRESENTATIONS_EXPORT vtkPointFrontConvertSelection
  : public vtkPConvertSelection
{
public:
  static vtkPointFrontConvertSelection* New();
  vtkTypeMacro(vtkPointFrontConvertSelection, vtkPConvertSelection);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkPointFrontConvertSelection();
  ~vtkPointFrontConvertSelection() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  /// Adds the names of all points of the store that a query selects; false, and an error, where
  /// they cannot be had.
  bool NameWhatIsSelected(vtkSelection* selection, vtkSelection* output);

  vtkPointFrontConvertSelection(const vtkPointFrontConvertSelection&) = delete;
  void operator=(const vtkPointFrontConvertSelection&) = delete;
};

#endif
