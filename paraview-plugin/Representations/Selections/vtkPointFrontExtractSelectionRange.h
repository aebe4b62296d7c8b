/**
 * @class vtkPointFrontExtractSelectionRange
 * @brief the range of an array over what is selected: behind "Rescale to Visible Data Range"
 *
 * ParaView's filter looks up rows of its input. Of a PointFront reader it is all selected points of
 * the store, on all ranks together.
 */
#ifndef vtkPointFrontExtractSelectionRange_h
#define vtkPointFrontExtractSelectionRange_h

#include "pointfrontParaViewRepresentationsModule.h" // for the export macro
#include "vtkExtractSelectionRange.h"

class POINTFRONTPARAVIEWREPRESENTATIONS_EXPORT vtkPointFrontExtractSelectionRange
  : public vtkExtractSelectionRange
{
public:
  static vtkPointFrontExtractSelectionRange* New();
  vtkTypeMacro(vtkPointFrontExtractSelectionRange, vtkExtractSelectionRange);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkPointFrontExtractSelectionRange();
  ~vtkPointFrontExtractSelectionRange() override;
  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkPointFrontExtractSelectionRange(const vtkPointFrontExtractSelectionRange&) = delete;
  void operator=(const vtkPointFrontExtractSelectionRange&) = delete;
};

#endif
