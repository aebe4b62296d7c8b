#include "vtkSMPointFrontReaderProxy.h"

#include "vtkCallbackCommand.h"
#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"
#include "vtkSMProxyManager.h"
#include "vtkSMSession.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkStringList.h"

#include <string>

vtkStandardNewMacro(vtkSMPointFrontReaderProxy);

namespace
{

const char* const group = "sources";

/// Whether it has another name than that: a source that is renamed has two for a moment.
bool hasOtherName(vtkSMProxy* proxy, const std::string& name)
{
  vtkNew<vtkStringList> names;
  proxy->GetSessionProxyManager()->GetProxyNames(group, proxy, names);
  bool other = false;
  for (int i = 0; i < names->GetNumberOfStrings(); ++i)
  {
    other = other || name != names->GetString(i);
  }
  return other;
}

void onUnregistered(vtkObject*, unsigned long, void*, void* told)
{
  const auto* gone = static_cast<vtkSMProxyManager::RegisteredProxyInformation*>(told);
  auto* reader = gone ? vtkSMPointFrontReaderProxy::SafeDownCast(gone->Proxy) : nullptr;
  if (!reader || !gone->GroupName || gone->GroupName != std::string(group) || !gone->ProxyName ||
    hasOtherName(reader, gone->ProxyName))
  {
    return;
  }
  // A session that ends takes the source with it.
  vtkSMSession* session = reader->GetSession();
  if (session && session->GetIsAlive())
  {
    reader->InvokeCommand("CloseStore");
  }
}

} // namespace

//------------------------------------------------------------------------------
vtkSMPointFrontReaderProxy::vtkSMPointFrontReaderProxy() = default;

//------------------------------------------------------------------------------
vtkSMPointFrontReaderProxy::~vtkSMPointFrontReaderProxy() = default;

//------------------------------------------------------------------------------
void vtkSMPointFrontReaderProxy::CreateVTKObjects()
{
  const bool created = this->ObjectsCreated != 0;
  this->Superclass::CreateVTKObjects();
  vtkSMSessionProxyManager* manager = this->GetSessionProxyManager();
  static const vtkSmartPointer<vtkCallbackCommand> listener = []
  {
    auto made = vtkSmartPointer<vtkCallbackCommand>::New();
    made->SetCallback(onUnregistered);
    return made;
  }();
  if (!created && this->ObjectsCreated && manager &&
    !manager->HasObserver(vtkCommand::UnRegisterEvent, listener))
  {
    manager->AddObserver(vtkCommand::UnRegisterEvent, listener);
  }
}
