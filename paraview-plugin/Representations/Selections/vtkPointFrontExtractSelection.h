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
 * Points are named by global ids, which are the points' numbers in the store
 * (vtkPointFrontEncodeSelection), by values of "point_id", or by a frustum, in which they are
 * ("Select Points Through"): an error if that reaches into parts of the cloud with more than 50
 * million points. A query on values selects among all points of the store: of comparisons joined by
 * "&" those are read that may meet it, for any other query all of them, 50 million on a process at
 * most.
 */
#ifndef vtkPointFrontExtractSelection_h
#define vtkPointFrontExtractSelection_h

#include "pointfrontParaViewRepresentationsModule.h" // for the export macro
#include "vtkPVExtractSelection.h"
#include "vtkSmartPointer.h" // for the reader

#include <string> // for names
#include <vector> // for names

class vtkPointFrontReader;
class vtkPolyData;
class vtkSelection;

class POINTFRONTPARAVIEWREPRESENTATIONS_EXPORT vtkPointFrontExtractSelection
  : public vtkPVExtractSelection
{
public:
  static vtkPointFrontExtractSelection* New();
  vtkTypeMacro(vtkPointFrontExtractSelection, vtkPVExtractSelection);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  /// The reader whose points are extracted, where the input does not come from it by connections;
  /// then the first rank gets what all extract, so that statistics are of all. Null (default): the
  /// input's reader.
  void SetReader(vtkPointFrontReader* reader);

  /// ParaView's HyperTreeGridToUnstructuredGrid, by a name that its releases before 5.12 lack, too.
  void SetHyperTreeGridsConverted(bool converted);

  /// Arrays of points that do not come along.
  void SetDroppedArrays(const std::vector<std::string>& names);

protected:
  vtkPointFrontExtractSelection();
  ~vtkPointFrontExtractSelection() override;

  int RequestData(vtkInformation*, vtkInformationVector**, vtkInformationVector*) override;

  /// For queries one that a malformed query does not end.
  vtkSmartPointer<vtkSelector> NewSelectionOperator(
    vtkSelectionNode::SelectionContent type) override;

private:
  vtkPointFrontExtractSelection(const vtkPointFrontExtractSelection&) = delete;
  void operator=(const vtkPointFrontExtractSelection&) = delete;

  /// The points to select among; null, and an error, where they cannot be read.
  vtkSmartPointer<vtkPolyData> GetCandidates(vtkPointFrontReader* reader, vtkPolyData* overview,
    vtkSelection* selection, int piece, int pieces);

  vtkSmartPointer<vtkPointFrontReader> Reader;
  std::vector<std::string> DroppedArrays;
};

#endif
