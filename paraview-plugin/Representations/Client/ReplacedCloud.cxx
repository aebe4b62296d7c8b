#include "ReplacedCloud.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkPVXMLElement.h"
#include "vtkSmartPointer.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMProxyManager.h"
#include "vtkSMSessionProxyManager.h"

#include <string>

namespace pointfront
{
namespace
{

/// As in a filter's definition.
constexpr int always = 1;
constexpr int ifSurface = 2;

/// Opens the protected setter of hints: definitions share theirs among all filters of a kind.
struct HintedProxy : vtkSMProxy
{
  static void set(vtkSMProxy* proxy, vtkPVXMLElement* hints)
  {
    (proxy->*&HintedProxy::SetHints)(hints);
  }
};

vtkSMProxy* inputOf(vtkSMProxy* proxy)
{
  vtkSMProperty* input = proxy ? proxy->GetProperty("Input") : nullptr;
  vtkSMPropertyHelper helper(input, /*quiet=*/true);
  return input && helper.GetNumberOfElements() == 1 ? helper.GetAsProxy() : nullptr;
}

bool isCloud(vtkSMProxy* source)
{
  const std::string name = source && source->GetXMLName() ? source->GetXMLName() : "";
  return name == "PointFrontReader" || name == "PointFrontFiles" || name == "PointFrontRemoteCloud";
}

void letReplaceCloud(vtkSMProxy* filter)
{
  vtkPVXMLElement* hints = filter->GetHints();
  vtkPVXMLElement* visibility = hints ? hints->FindNestedElementByName("Visibility") : nullptr;
  int replaces = 0;
  if (!visibility || !visibility->GetScalarAttribute("replace_input", &replaces) ||
    replaces != ifSurface || !isCloud(inputOf(filter)))
  {
    return;
  }
  vtkNew<vtkPVXMLElement> own;
  hints->CopyTo(own);
  own->FindNestedElementByName("Visibility")
    ->SetAttribute("replace_input", std::to_string(always).c_str());
  HintedProxy::set(filter, own);
}

void onRegistered(vtkObject*, unsigned long, void*, void* told)
{
  const auto* made = static_cast<vtkSMProxyManager::RegisteredProxyInformation*>(told);
  if (made && made->Proxy && made->GroupName && made->GroupName == std::string("sources"))
  {
    letReplaceCloud(made->Proxy);
  }
}

} // namespace

void letFiltersReplaceClouds(vtkSMSessionProxyManager* session)
{
  static const vtkSmartPointer<vtkCallbackCommand> listener = []
  {
    auto made = vtkSmartPointer<vtkCallbackCommand>::New();
    made->SetCallback(onRegistered);
    return made;
  }();
  if (!session->HasObserver(vtkCommand::RegisterEvent, listener))
  {
    session->AddObserver(vtkCommand::RegisterEvent, listener);
  }
}

} // namespace pointfront
