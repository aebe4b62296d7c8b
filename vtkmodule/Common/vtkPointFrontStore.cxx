#include "vtkPointFrontStore.h"

#include "CloudFormats.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Disk/ByteTraffic.h"
#include "pointfront/Disk/Epoch.h"
#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Residency/ResidencyShare.h"
#include "pointfront/Store/PreviewRecord.h"
#include "pointfront/Threads/OfProcess.h"
#include "pointfront/Tiles/StoredCloudFormats.h"

#include <vtkDataObject.h>
#include <vtkFieldData.h>
#include <vtkIndent.h>
#include <vtkNew.h>
#include <vtkStringArray.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <exception>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <new>
#include <string>
#include <tuple>
#include <utility>

namespace
{

/// The identity of a file: its canonical path, with the epoch of a collection, and values that
/// change when it is built anew. Of an address: its public form, and the source that is open for
/// it.
using FileIdentity = std::tuple<std::string, std::uintmax_t, std::int64_t>;

/// Asks the server, unless the address is open. `source` is what came.
bool identifyFar(const std::string& address, FileIdentity& identity,
  std::shared_ptr<const pointfront::ByteSource>& source, std::string& error)
{
  pointfront::EpochAddress asked = pointfront::EpochAddress::of(address);
  auto opened = pointfront::StoredCloudFormats::openFar(asked.file);
  if (!opened)
  {
    error = opened.error().what;
    return false;
  }
  source = std::move(*opened); // another one once somebody has replaced the file on its server
  asked.file = pointfront::publicForm(asked.file);
  identity = { asked.text(), reinterpret_cast<std::uintptr_t>(source.get()), 0 };
  return true;
}

bool identify(const std::string& fileName, FileIdentity& identity, std::string& error)
{
  std::error_code code;
  pointfront::EpochAddress asked = pointfront::EpochAddress::of(fileName);
  const std::filesystem::path path =
    std::filesystem::canonical(pointfront::presentStorePath(asked.file), code);
  if (code)
  {
    error = "cannot open the store " + fileName + ": " + code.message() + "; check the path";
    return false;
  }
  const bool folder = std::filesystem::is_directory(path, code); // a folder of tiles has no bytes
  const auto bytes = folder ? std::uintmax_t(0) : std::filesystem::file_size(path, code);
  if (code)
  {
    error = "cannot open the store " + path.string() + ": " + code.message() +
      "; name a file or a folder";
    return false;
  }
  const auto written = std::filesystem::last_write_time(path, code);
  asked.file = path.string();
  identity = { asked.text(), bytes, static_cast<std::int64_t>(written.time_since_epoch().count()) };
  return true;
}

/// The open stores of this process (a child of fork() opens its own), and those that a thread is
/// opening. Weak: an entry leaves before the last reference to its store does. The lock is never
/// held while a file is read or a store is closed: a disk that hangs stops who wants the store that
/// lies on it, and nobody else.
struct Registry
{
  std::mutex mutex;
  std::map<FileIdentity, vtkPointFrontStore*> stores; ///< null: being opened
  std::condition_variable opened;
};

/// Whether the process's budget was set, or follows those of single stores.
struct ProcessBudget
{
  std::mutex mutex;
  bool set = false;
};

ProcessBudget& processBudget()
{
  static ProcessBudget* instance = new ProcessBudget;
  return *instance;
}

std::size_t bytesOf(vtkTypeInt64 bytes)
{
  return bytes < 0 ? 0 : static_cast<std::size_t>(bytes);
}

Registry& registry()
{
  // Never deleted: stores may outlive static objects.
  static auto* const instance = new pointfront::OfProcess<Registry>;
  return instance->get([] { return std::make_unique<Registry>(); });
}

} // namespace

constexpr std::chrono::milliseconds betweenLooks{ 250 };

struct vtkPointFrontStore::Content
{
  FileIdentity identity;
  std::shared_ptr<const pointfront::ByteSource> source; ///< behind an address; null for files
  bool preview = false;
  std::chrono::steady_clock::time_point looked;
  std::shared_ptr<const pointfront::StoredCloud> store;
  std::unique_ptr<pointfront::ResidencyShare> residency;
};

vtkPointFrontStore::vtkPointFrontStore()
  : Internals(new Content)
{
}

vtkPointFrontStore::~vtkPointFrontStore() = default;

void vtkPointFrontStore::UnRegisterInternal(vtkObjectBase* holder, vtkTypeBool check)
{
  Registry& all = registry();
  {
    // Every reference goes here, and Open() gives none without the lock: the last is the last.
    const std::lock_guard<std::mutex> lock(all.mutex);
    if (this->GetReferenceCount() > 1)
    {
      this->Superclass::UnRegisterInternal(holder, check);
      return;
    }
    const auto entry = all.stores.find(this->Internals->identity);
    if (entry != all.stores.end() && entry->second == this)
    {
      all.stores.erase(entry);
    }
  }
  this->Superclass::UnRegisterInternal(holder, check);
}

vtkSmartPointer<vtkPointFrontStore> vtkPointFrontStore::Open(
  const char* fileName, vtkStdString& error)
{
  error.clear();
  if (!fileName || !*fileName)
  {
    error = "no store is named; set a file name";
    return nullptr;
  }
  GetFormats(); // with them come the schemes of addresses
  FileIdentity identity;
  std::shared_ptr<const pointfront::ByteSource> source;
  const bool found = pointfront::isAddress(fileName)
    ? identifyFar(fileName, identity, source, error)
    : identify(fileName, identity, error);
  if (!found)
  {
    return nullptr;
  }
  Registry& all = registry();
  {
    std::unique_lock<std::mutex> lock(all.mutex);
    auto entry = all.stores.find(identity);
    while (entry != all.stores.end() && entry->second == nullptr)
    {
      all.opened.wait(lock); // another thread opens it
      entry = all.stores.find(identity);
    }
    if (entry != all.stores.end())
    {
      return entry->second;
    }
    all.stores.emplace(identity, nullptr);
  }
  vtkSmartPointer<vtkPointFrontStore> made = OpenFile(std::get<0>(identity), error);
  {
    const std::lock_guard<std::mutex> lock(all.mutex);
    if (made)
    {
      made->Internals->identity = identity;
      made->Internals->source = std::move(source);
      all.stores[identity] = made;
    }
    else
    {
      all.stores.erase(identity);
    }
  }
  all.opened.notify_all();
  return made;
}

pointfront::StoredCloudFormats& vtkPointFrontStore::GetFormats()
{
  static const bool added = (pointfront::addCloudFormats(), true);
  static_cast<void>(added);
  return pointfront::StoredCloudFormats::ofProcess();
}

vtkSmartPointer<vtkPointFrontStore> vtkPointFrontStore::OpenFile(
  const std::string& path, std::string& error)
{
  try
  {
    return Made(path, error);
  }
  catch (const std::bad_alloc&)
  {
    error = "not enough memory to open the store " + path;
  }
  catch (const std::exception& problem) // else all who open it later would wait for ever
  {
    error = "cannot open the store " + path + ": " + problem.what();
  }
  return nullptr;
}

vtkSmartPointer<vtkPointFrontStore> vtkPointFrontStore::Made(
  const std::string& path, std::string& error)
{
  auto opened = GetFormats().open(path);
  if (!opened)
  {
    error = opened.error().what;
    return nullptr;
  }
  auto* made = new vtkPointFrontStore;
  made->InitializeObjectBase();
  auto result = vtkSmartPointer<vtkPointFrontStore>::Take(made);
  Content& content = *made->Internals;
  content.store = std::move(opened).value();
  content.preview = pointfront::previewRecordOf(content.store->description().metadata).has_value();
  content.residency = std::make_unique<pointfront::ResidencyShare>(content.store,
    content.store->hierarchy()->nodeCount(), pointfront::LoadScheduler::ofProcess(),
    content.store->description().pointCount);
  return result;
}

void vtkPointFrontStore::SetStoreName(vtkDataObject* data, const char* fileName)
{
  vtkNew<vtkStringArray> name;
  name->SetName(FieldName());
  name->InsertNextValue(fileName ? fileName : "");
  data->GetFieldData()->RemoveArray(FieldName());
  data->GetFieldData()->AddArray(name);
}

vtkStdString vtkPointFrontStore::GetStoreName(vtkDataObject* data)
{
  vtkFieldData* fields = data ? data->GetFieldData() : nullptr;
  auto* name =
    fields ? vtkStringArray::SafeDownCast(fields->GetAbstractArray(FieldName())) : nullptr;
  return name && name->GetNumberOfValues() > 0 ? name->GetValue(0) : vtkStdString();
}

bool vtkPointFrontStore::IsPreview() const
{
  return this->Internals->preview;
}

bool vtkPointFrontStore::HasSuccessor()
{
  const auto now = std::chrono::steady_clock::now();
  if (!this->Internals->preview || this->Internals->source ||
    now - this->Internals->looked < betweenLooks)
  {
    return false;
  }
  this->Internals->looked = now;
  FileIdentity identity;
  std::string error;
  return identify(this->GetFileName(), identity, error) && identity != this->Internals->identity;
}

vtkSmartPointer<vtkPointFrontStore> vtkPointFrontStore::GetSuccessor()
{
  FileIdentity identity;
  std::string error;
  if (!this->Internals->preview || this->Internals->source ||
    !identify(this->GetFileName(), identity, error) || identity == this->Internals->identity)
  {
    return nullptr;
  }
  vtkStdString reason; // a build that ends in this moment: the next look finds what is there then
  return Open(this->GetFileName(), reason);
}

const char* vtkPointFrontStore::GetFileName() const
{
  return std::get<0>(this->Internals->identity).c_str();
}

void vtkPointFrontStore::GetBounds(double bounds[6]) const
{
  const pointfront::Bounds& b = this->Internals->store->description().bounds;
  for (int axis = 0; axis < 3; ++axis)
  {
    bounds[2 * axis] = b.empty() ? 1.0 : b.low[axis]; // as vtkMath::UninitializeBounds()
    bounds[2 * axis + 1] = b.empty() ? -1.0 : b.high[axis];
  }
}

vtkIdType vtkPointFrontStore::GetNumberOfPoints() const
{
  return static_cast<vtkIdType>(this->Internals->store->description().pointCount);
}

vtkIdType vtkPointFrontStore::GetNumberOfPointsOfAllStores()
{
  Registry& all = registry();
  const std::lock_guard<std::mutex> lock(all.mutex);
  vtkIdType points = 0;
  for (const auto& entry : all.stores)
  {
    points += entry.second != nullptr ? entry.second->GetNumberOfPoints() : 0;
  }
  return points;
}

vtkTypeInt64 vtkPointFrontStore::GetNumberOfFarRequests()
{
  return static_cast<vtkTypeInt64>(pointfront::ByteTraffic::ofProcess().requests);
}

vtkTypeInt64 vtkPointFrontStore::GetNumberOfFarBytes()
{
  return static_cast<vtkTypeInt64>(pointfront::ByteTraffic::ofProcess().bytes);
}

vtkTypeInt64 vtkPointFrontStore::GetNumberOfCachedBytes()
{
  return static_cast<vtkTypeInt64>(pointfront::ByteTraffic::ofProcess().cacheBytes);
}

int vtkPointFrontStore::GetNumberOfAttributes() const
{
  return static_cast<int>(this->Internals->store->description().schema.size());
}

const char* vtkPointFrontStore::GetAttributeName(int attribute) const
{
  if (attribute < 0 || attribute >= this->GetNumberOfAttributes())
  {
    return nullptr;
  }
  const auto column = static_cast<std::size_t>(attribute);
  return this->Internals->store->description().schema[column].name.c_str();
}

int vtkPointFrontStore::GetNumberOfObjectClasses() const
{
  return static_cast<int>(this->Internals->store->description().layers.size());
}

const char* vtkPointFrontStore::GetObjectClassName(int index) const
{
  const auto& layers = this->Internals->store->description().layers;
  return index >= 0 && index < this->GetNumberOfObjectClasses()
    ? layers[static_cast<std::size_t>(index)].name.c_str()
    : nullptr;
}

int vtkPointFrontStore::GetObjectClassNumber(int index) const
{
  const auto& layers = this->Internals->store->description().layers;
  const bool single = layers.size() == 1 && layers.front().name == "all";
  return index >= 0 && index < this->GetNumberOfObjectClasses() && !single
    ? layers[static_cast<std::size_t>(index)].objectClass
    : -1;
}

void vtkPointFrontStore::SetHostMemoryBudget(vtkTypeInt64 bytes)
{
  const std::size_t own = bytesOf(bytes);
  {
    ProcessBudget& process = processBudget();
    const std::lock_guard<std::mutex> lock(process.mutex);
    if (!process.set && own > pointfront::LoadScheduler::processBudgetBytes())
    {
      pointfront::LoadScheduler::setProcessBudgetBytes(own);
    }
  }
  if (own != this->Internals->residency->budgetBytes())
  {
    this->Internals->residency->setBudgetBytes(own);
    this->Modified();
  }
}

void vtkPointFrontStore::SetProcessMemoryBudget(vtkTypeInt64 bytes)
{
  ProcessBudget& process = processBudget();
  const std::lock_guard<std::mutex> lock(process.mutex);
  process.set = true;
  pointfront::LoadScheduler::setProcessBudgetBytes(bytesOf(bytes));
}

vtkTypeInt64 vtkPointFrontStore::GetProcessMemoryBudget()
{
  return static_cast<vtkTypeInt64>(pointfront::LoadScheduler::processBudgetBytes());
}

vtkTypeInt64 vtkPointFrontStore::GetHostMemoryBudget() const
{
  return static_cast<vtkTypeInt64>(this->Internals->residency->budgetBytes());
}

const std::shared_ptr<const pointfront::StoredCloud>& vtkPointFrontStore::GetStore() const
{
  return this->Internals->store;
}

pointfront::ResidencyShare& vtkPointFrontStore::GetResidencyShare() const
{
  return *this->Internals->residency;
}

pointfront::Residency& vtkPointFrontStore::GetResidency() const
{
  return this->Internals->residency->residency();
}

void vtkPointFrontStore::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->GetFileName() << "\n";
  os << indent << "IsPreview: " << this->IsPreview() << "\n";
  os << indent << "NumberOfPoints: " << this->GetNumberOfPoints() << "\n";
  os << indent << "HostMemoryBudget: " << this->GetHostMemoryBudget() << "\n";
}
