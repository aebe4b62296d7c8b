/**
 * @class vtkPointFrontExtractSelectedPoints
 * @brief the filter Extract Selection: vtkPointFrontExtractSelection with the extracted data alone
 *
 * ParaView's internal extraction has two more outputs, which are selections.
 */
#ifndef vtkPointFrontExtractSelectedPoints_h
#define vtkPointFrontExtractSelectedPoints_h

#include "pointfrontParaViewRepresentationsModule.h" // for the export macro
#include "vtkPointFrontExtractSelection.h"

class POINTFRONTPARAVIEWREPRESENTATIONS_EXPORT vtkPointFrontExtractSelectedPoints
  : public vtkPointFrontExtractSelection
{
public:
  static vtkPointFrontExtractSelectedPoints* New();
  vtkTypeMacro(vtkPointFrontExtractSelectedPoints, vtkPointFrontExtractSelection);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkPointFrontExtractSelectedPoints();
  ~vtkPointFrontExtractSelectedPoints() override;

private:
  vtkPointFrontExtractSelectedPoints(const vtkPointFrontExtractSelectedPoints&) = delete;
  void operator=(const vtkPointFrontExtractSelectedPoints&) = delete;
};

#endif
