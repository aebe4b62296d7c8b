#include "vtkSMPointFrontRepresentationProxy.h"

#include "ClassCategories.h"
#include "ColourLegends.h"
#include "QualityWidgets.h"
#include "ReplacedCloud.h"

#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointFrontEncodeSelection.h"
#include "vtkPointFrontRepresentation.h"
#include "vtkProcessModule.h"
#include "vtkPVPointFrontClasses.h"
#include "vtkPVPointFrontFrame.h"
#include "vtkRenderWindowInteractor.h"
#include "vtkSMParaViewPipelineController.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSession.h"
#include "vtkSMSessionClient.h"
#include "vtkSMStringVectorProperty.h"
#include "vtkSMViewProxy.h"
#include "vtkStringList.h"

#include <algorithm>

vtkStandardNewMacro(vtkSMPointFrontRepresentationProxy);

namespace
{
/// After a still render: about what a node takes from a warm disk.
constexpr int StillDelay = 20;
/// After an interactive render: not before the hand rests, for the next mouse move shall find the
/// client idle.
constexpr int InteractiveDelay = 250;
/// Between questions while nothing comes, doubled each time up to this.
constexpr int LongestDelay = 500;
} // namespace

//------------------------------------------------------------------------------
vtkSMPointFrontRepresentationProxy::vtkSMPointFrontRepresentationProxy()
{
  vtkPointFrontEncodeSelection::Register();
}

//------------------------------------------------------------------------------
vtkSMPointFrontRepresentationProxy::~vtkSMPointFrontRepresentationProxy()
{
  this->Unfollow();
}

//------------------------------------------------------------------------------
void vtkSMPointFrontRepresentationProxy::ViewUpdated(vtkSMProxy* view)
{
  this->Superclass::ViewUpdated(view);
  this->GatherClasses();
  this->TellStore();
  this->Follow(vtkSMViewProxy::SafeDownCast(view));
  this->OnRender(view, vtkCommand::StartEvent, nullptr);
}

//------------------------------------------------------------------------------
void vtkSMPointFrontRepresentationProxy::CreateVTKObjects()
{
  const bool created = this->ObjectsCreated != 0;
  this->Superclass::CreateVTKObjects();
  if (!created && this->ObjectsCreated)
  {
    vtkNew<vtkSMParaViewPipelineController> controller;
    controller->UpdateSettingsProxies(this->GetSession());
    // Where users look: ParaView shows it for the representation "Points" only.
    vtkSMProxy* representation = this->GetTrueParentProxy();
    vtkSMProperty* size = representation ? representation->GetProperty("PointSize") : nullptr;
    size ? size->SetPanelVisibility("default") : void();
    pointfront::letFiltersReplaceClouds(this->GetSessionProxyManager());
  }
}

//------------------------------------------------------------------------------
void vtkSMPointFrontRepresentationProxy::SetPropertyModifiedFlag(const char* name, int flag)
{
  this->Superclass::SetPropertyModifiedFlag(name, flag);
  if (flag != 0 && name && this->ObjectsCreated && !this->Agreeing)
  {
    this->Agreeing = true;
    pointfront::agreeOnQuality(this, name);
    this->Agreeing = false;
  }
}

//------------------------------------------------------------------------------
void vtkSMPointFrontRepresentationProxy::GatherClasses()
{
  vtkNew<vtkPVPointFrontClasses> classes;
  this->GatherInformation(classes);
  this->Classes = classes->GetNames();
  this->TellClasses();
  if (!this->Classes.empty())
  {
    this->ListClasses();
  }
}

//------------------------------------------------------------------------------
void vtkSMPointFrontRepresentationProxy::ListClasses()
{
  auto* property = vtkSMStringVectorProperty::SafeDownCast(this->GetProperty("Classes"));
  const std::vector<std::string> before = property->GetElements();
  // A state or a script may have chosen already: then the others are off.
  const bool otherwise = !this->ClassShown.empty() || before.empty();
  for (std::size_t i = 0; i + 1 < before.size(); i += 2)
  {
    this->ClassShown[before[i]] = before[i + 1] != "0";
  }
  std::vector<std::string> after;
  for (const std::string& name : this->Classes)
  {
    const bool shown = this->ClassShown.try_emplace(name, otherwise).first->second;
    after.insert(after.end(), { name, shown ? "1" : "0" });
  }
  // Classes of earlier stores that are off: the property says so until they come again.
  for (const auto& [name, shown] : this->ClassShown)
  {
    const auto end = this->Classes.end();
    if (!shown && std::find(this->Classes.begin(), end, name) == end)
    {
      after.insert(after.end(), { name, "0" });
    }
  }
  if (after != before)
  {
    property->SetElements(after);
    this->UpdateVTKObjects();
  }
}

//------------------------------------------------------------------------------
void vtkSMPointFrontRepresentationProxy::TellStore()
{
  // Apply has told the panel of the reader what there was then: of a build the preview.
  vtkSMProxy* representation = this->GetTrueParentProxy();
  vtkSMProperty* input = representation ? representation->GetProperty("Input") : nullptr;
  vtkSMProxy* reader = input ? vtkSMPropertyHelper(input).GetAsProxy() : nullptr;
  if (reader && reader->GetXMLName() == std::string("PointFrontFiles"))
  {
    reader->UpdatePropertyInformation(reader->GetProperty("StoreFacts"));
  }
}

//------------------------------------------------------------------------------
void vtkSMPointFrontRepresentationProxy::TellClasses()
{
  // As an array selection tells of its arrays: pairs of a name and whether it is on by default.
  vtkNew<vtkStringList> pairs;
  for (const std::string& name : this->Classes)
  {
    pairs->AddString(name.c_str());
    pairs->AddString("1");
  }
  vtkSMStringVectorProperty::SafeDownCast(this->GetProperty("ClassInfo"))->SetElements(pairs);
}

//------------------------------------------------------------------------------
void vtkSMPointFrontRepresentationProxy::Follow(vtkSMViewProxy* view)
{
  const bool batch = vtkProcessModule::GetProcessType() == vtkProcessModule::PROCESS_BATCH;
  vtkRenderWindowInteractor* interactor = view && !batch ? view->GetInteractor() : nullptr;
  if (view == this->View && interactor == this->Interactor)
  {
    return;
  }
  this->Unfollow();
  if (view)
  {
    this->View = view;
    this->StartObserver = view->AddObserver(
      vtkCommand::StartEvent, this, &vtkSMPointFrontRepresentationProxy::OnRender);
  }
  if (interactor)
  {
    this->Interactor = interactor;
    this->RenderObserver = view->AddObserver(
      vtkCommand::EndEvent, this, &vtkSMPointFrontRepresentationProxy::OnRendered);
    this->TimerObserver = interactor->AddObserver(
      vtkCommand::TimerEvent, this, &vtkSMPointFrontRepresentationProxy::OnTimer);
  }
}

//------------------------------------------------------------------------------
void vtkSMPointFrontRepresentationProxy::Unfollow()
{
  this->StopTimer();
  if (this->View)
  {
    this->View->RemoveObserver(this->StartObserver);
    this->View->RemoveObserver(this->RenderObserver);
  }
  if (this->Interactor)
  {
    this->Interactor->RemoveObserver(this->TimerObserver);
  }
  this->View = nullptr;
  this->Interactor = nullptr;
  this->RenderObserver = 0;
}

//------------------------------------------------------------------------------
bool vtkSMPointFrontRepresentationProxy::IsActive()
{
  // The client has a representation of its own: no question to the server.
  auto* local = vtkPointFrontRepresentation::SafeDownCast(this->GetClientSideObject());
  return local && local->GetVisibility() && local->GetView();
}

//------------------------------------------------------------------------------
bool vtkSMPointFrontRepresentationProxy::IsSessionBusy()
{
  auto* client = vtkSMSessionClient::SafeDownCast(this->GetSession());
  return this->GetSession()->GetPendingProgress() || (client && !client->IsNotBusy());
}

//------------------------------------------------------------------------------
void vtkSMPointFrontRepresentationProxy::StartTimer(int milliseconds)
{
  this->StopTimer();
  if (this->Interactor)
  {
    this->Delay = milliseconds;
    this->Timer = this->Interactor->CreateOneShotTimer(static_cast<unsigned long>(milliseconds));
  }
}

//------------------------------------------------------------------------------
void vtkSMPointFrontRepresentationProxy::StopTimer()
{
  if (this->Timer > 0 && this->Interactor)
  {
    this->Interactor->DestroyTimer(this->Timer);
  }
  this->Timer = 0;
}

//------------------------------------------------------------------------------
void vtkSMPointFrontRepresentationProxy::OnRender(vtkObject* view, unsigned long, void*)
{
  if (this->IsActive())
  {
    pointfront::nameClasses(this, this->Classes);
    pointfront::hideUnusedLegends(vtkSMViewProxy::SafeDownCast(view));
  }
}

//------------------------------------------------------------------------------
void vtkSMPointFrontRepresentationProxy::OnRendered(vtkObject*, unsigned long, void* interactive)
{
  if (this->IsActive())
  {
    this->StartTimer(*static_cast<int*>(interactive) ? InteractiveDelay : StillDelay);
  }
  else
  {
    this->StopTimer();
  }
}

//------------------------------------------------------------------------------
void vtkSMPointFrontRepresentationProxy::OnTimer(vtkObject*, unsigned long, void* timer)
{
  if (!timer || *static_cast<int*>(timer) != this->Timer || this->Timer == 0)
  {
    return; // somebody else's property
  }
  this->Timer = 0;
  if (!this->IsActive())
  {
    return;
  }
  if (this->IsSessionBusy())
  {
    this->StartTimer(this->Delay);
    return;
  }
  vtkNew<vtkPVPointFrontFrame> frame;
  // vtkSMSessionClient returns false always; a frame that could not be gathered says "complete",
  // which ends here.
  this->GatherInformation(frame);
  this->TellFrame(frame);
  if (frame->GetOutdated())
  {
    // Without a window of its own the interactor renders through ParaView's proxies; OnRendered
    // comes next.
    this->Interactor->InvokeEvent(vtkCommand::RenderEvent, nullptr);
  }
  else if (!frame->GetComplete())
  {
    this->StartTimer(std::min(2 * this->Delay, LongestDelay));
  }
}

//------------------------------------------------------------------------------
void vtkSMPointFrontRepresentationProxy::UpdatePropertyInformationInternal(vtkSMProperty* property)
{
  this->Superclass::UpdatePropertyInformationInternal(property);
  this->TellClasses(); // the client's own is empty
  if (!this->IsActive())
  {
    return;
  }
  vtkNew<vtkPVPointFrontFrame> frame;
  this->GatherInformation(frame);
  this->TellFrame(frame);
}

//------------------------------------------------------------------------------
void vtkSMPointFrontRepresentationProxy::TellFrame(vtkPVPointFrontFrame* frame)
{
  vtkSMPropertyHelper(this, "PointsDrawn").Set(frame->GetPointsDrawn());
  vtkSMPropertyHelper(this, "PointsInView").Set(frame->GetPointsInView().c_str());
  vtkSMPropertyHelper(this, "NodesDrawn").Set(frame->GetNodesDrawn());
  vtkSMPropertyHelper(this, "ProjectedSpacing").Set(frame->GetProjectedSpacing());
  vtkSMPropertyHelper(this, "LimitedBy").Set(frame->GetLimitedBy().c_str());
  vtkSMPropertyHelper(this, "Traffic").Set(frame->GetTraffic().c_str());
  vtkSMPropertyHelper(this, "ExpectedDifference").Set(frame->GetExpectedDifference().c_str());
  vtkSMPropertyHelper(this, "HostMemoryBudget").Set(frame->GetHostMemoryBudget());
  vtkSMPropertyHelper(this, "FrameComplete").Set(frame->GetComplete() ? 1 : 0);
}

//------------------------------------------------------------------------------
void vtkSMPointFrontRepresentationProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "View: " << this->View.Get() << "\n"
     << indent << "Delay: " << this->Delay << " ms\n";
}
