/**
 * @class vtkPointFrontExtractSelectedArraysOverTime
 * @brief ParaView's Plot Selection Over Time, which finds all points of each store
 *
 * The server manager makes it for the filter of that name (XML/Selection.xml). What comes from any
 * other source than a vtkPointFrontReader is treated as ever. The stores of a reader's time steps
 * do not name their points alike, so of several steps only statistics are given, and anything else
 * is an error. Attributes that are not alike in all of the stores are left out.
 */
#ifndef vtkPointFrontExtractSelectedArraysOverTime_h
#define vtkPointFrontExtractSelectedArraysOverTime_h

#include "pointfrontParaViewRepresentationsModule.h" // for the export macro
#include "vtkPExtractSelectedArraysOverTime.h"

class POINTFRONTPARAVIEWREPRESENTATIONS_EXPORT vtkPointFrontExtractSelectedArraysOverTime
  : public vtkPExtractSelectedArraysOverTime
{
public:
  static vtkPointFrontExtractSelectedArraysOverTime* New();
  vtkTypeMacro(vtkPointFrontExtractSelectedArraysOverTime, vtkPExtractSelectedArraysOverTime);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkPointFrontExtractSelectedArraysOverTime();
  ~vtkPointFrontExtractSelectedArraysOverTime() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkPointFrontExtractSelectedArraysOverTime(
    const vtkPointFrontExtractSelectedArraysOverTime&) = delete;
  void operator=(const vtkPointFrontExtractSelectedArraysOverTime&) = delete;
};

#endif
