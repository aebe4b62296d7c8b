/**
 * @class vtkPointFrontExtractSelection
 * @brief ParaView's extraction of a selection, which finds all points of a store, not only those of
 * its overview
 *
 * The server manager makes it wherever ParaView extracts a selection (XML/Selection.xml). What is
 * extracted from any other source is extracted as ever. From a vtkPointFrontReader the points to
 * choose from are its output and behind it the points of the store that the selection names and the
 * output lacks; so row numbers of the output keep their meaning. With several processes
 * each reads its share of the named points.
 *
 * Points are named by global ids, which are ranks in the store (vtkPointFrontEncodeSelection), by
 * values of "point_id", or by a frustum, in which they are ("Select Points Through"): an error if
 * that reaches into parts of the cloud with more than 50 million points.
 */
#ifndef vtkPointFrontExtractSelection_h
#define vtkPointFrontExtractSelection_h

#include "pointfrontParaViewRepresentationsModule.h" // for the export macro
#include "vtkPVExtractSelection.h"

class POINTFRONTPARAVIEWREPRESENTATIONS_EXPORT vtkPointFrontExtractSelection
  : public vtkPVExtractSelection
{
public:
  static vtkPointFrontExtractSelection* New();
  vtkTypeMacro(vtkPointFrontExtractSelection, vtkPVExtractSelection);
  void PrintSelf(ostream& os, vtkIndent indent) override;

protected:
  vtkPointFrontExtractSelection();
  ~vtkPointFrontExtractSelection() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

private:
  vtkPointFrontExtractSelection(const vtkPointFrontExtractSelection&) = delete;
  void operator=(const vtkPointFrontExtractSelection&) = delete;

  bool ToldOfOverview = false; ///< that a query has no more to select among
};

#endif
