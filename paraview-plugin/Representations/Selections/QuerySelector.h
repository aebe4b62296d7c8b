#pragma once

#include "vtkNew.h"
#include "vtkSelector.h"
#include "vtkSmartPointer.h"

class vtkAlgorithm;

namespace pointfront
{

/// ParaView's selector of queries, which leaves no answer where a query is malformed: VTK then
/// reads through a null pointer. Here nothing is selected, and the filter has an error.
class QuerySelector : public vtkSelector
{
public:
  static QuerySelector* New();
  vtkTypeMacro(QuerySelector, vtkSelector);

  /// `inner` does the work; `filter` outlives this object.
  void wrap(vtkSelector* inner, vtkAlgorithm* filter);

  void Initialize(vtkSelectionNode* node) override;
  void Finalize() override;
  void Execute(vtkDataObject* input, vtkDataObject* output) override;

protected:
  bool ComputeSelectedElements(vtkDataObject*, vtkSignedCharArray*) override { return false; }

private:
  vtkSmartPointer<vtkSelector> inner_;
  vtkAlgorithm* filter_ = nullptr;
};

} // namespace pointfront
