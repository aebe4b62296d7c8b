#include "vtkPointFrontReader.h"

#include "pointfront/Disk/FarSettings.h"

#include <vtkErrorCode.h>
#include <vtkIndent.h>

#include <cstdint>
#include <string>

bool vtkPointFrontReader::FindName(const std::string& name, std::string& named)
{
  pointfront::FarSettings settings;
  if (this->Offline >= 0)
  {
    settings.offline = this->Offline > 0;
  }
  if (!this->CacheFolder.empty())
  {
    settings.cacheFolder = this->CacheFolder;
  }
  if (this->CacheSize >= 0)
  {
    settings.cacheBytes = static_cast<std::uint64_t>(this->CacheSize);
  }
  if (this->TimeLimit > 0.0)
  {
    settings.timeoutSeconds = this->TimeLimit;
  }
  const pointfront::Result<std::string> found = settings.named(name);
  if (!found)
  {
    this->SetErrorCode(vtkErrorCode::UserError);
    vtkErrorMacro(<< found.error().what);
    return false;
  }
  named = *found;
  return true;
}

void vtkPointFrontReader::PrintSettings(ostream& os, vtkIndent indent) const
{
  os << indent << "Offline: " << this->Offline << "\n";
  os << indent << "CacheFolder: " << this->CacheFolder << "\n";
  os << indent << "CacheSize: " << this->CacheSize << "\n";
  os << indent << "TimeLimit: " << this->TimeLimit << "\n";
}
