#include "vtkPointFrontEncodeSelection.h"

#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPointFrontRepresentation.h"
#include "vtkSelection.h"
#include "vtkSelectionNode.h"
#include "vtkVersion.h"

vtkStandardNewMacro(vtkPointFrontEncodeSelection);

namespace
{

VTK_CREATE_CREATE_FUNCTION(vtkPointFrontEncodeSelection)

class SelectionFactory : public vtkObjectFactory
{
public:
  static SelectionFactory* New();
  vtkTypeMacro(SelectionFactory, vtkObjectFactory);
  const char* GetVTKSourceVersion() override { return VTK_SOURCE_VERSION; }
  const char* GetDescription() override { return "selections of point stores"; }

protected:
  SelectionFactory()
  {
    this->RegisterOverride("vtkPVEncodeSelectionForServer", "vtkPointFrontEncodeSelection",
      "points of a store by their ids", 1, vtkObjectFactoryCreatevtkPointFrontEncodeSelection);
  }
};
vtkStandardNewMacro(SelectionFactory);

} // namespace

//------------------------------------------------------------------------------
vtkPointFrontEncodeSelection::vtkPointFrontEncodeSelection() = default;

//------------------------------------------------------------------------------
vtkPointFrontEncodeSelection::~vtkPointFrontEncodeSelection() = default;

//------------------------------------------------------------------------------
void vtkPointFrontEncodeSelection::Register()
{
  static const bool registered = []
  {
    vtkObjectFactory* factory = SelectionFactory::New();
    vtkObjectFactory::RegisterFactory(factory);
    factory->Delete();
    return true;
  }();
  static_cast<void>(registered);
}

//------------------------------------------------------------------------------
bool vtkPointFrontEncodeSelection::ProcessSelection(vtkSelection* rawSelection,
  vtkSMRenderViewProxy* viewProxy, bool multipleSelectionsAllowed,
  vtkCollection* selectedRepresentations, vtkCollection* selectionSources, int modifier,
  bool selectBlocks)
{
  for (unsigned int i = 0; rawSelection && i < rawSelection->GetNumberOfNodes(); ++i)
  {
    vtkSelectionNode* node = rawSelection->GetNode(i);
    vtkInformation* properties = node->GetProperties();
    if (properties->Has(vtkSelectionNode::SOURCE()) &&
      vtkPointFrontRepresentation::SafeDownCast(properties->Get(vtkSelectionNode::SOURCE())))
    {
      node->SetContentType(vtkSelectionNode::GLOBALIDS);
      node->SetFieldType(vtkSelectionNode::POINT);
      properties->Remove(vtkSelectionNode::PROCESS_ID());
    }
  }
  return this->Superclass::ProcessSelection(rawSelection, viewProxy, multipleSelectionsAllowed,
    selectedRepresentations, selectionSources, modifier, selectBlocks);
}

//------------------------------------------------------------------------------
void vtkPointFrontEncodeSelection::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}
