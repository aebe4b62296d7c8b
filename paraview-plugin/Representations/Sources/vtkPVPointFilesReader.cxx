#include "vtkPVPointFilesReader.h"

#include "PointFileNames.h"

#include "pointfront/Store/PreviewRecord.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Tiles/StoredCloudFormats.h"

#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkPointFrontBuilder.h"
#include "vtkPointFrontStore.h"
#include "vtkSmartPointer.h"

#include <cmath>
#include <filesystem>
#include <sstream>
#include <system_error>
#include <utility>

vtkStandardNewMacro(vtkPVPointFilesReader);

namespace
{

/// Since the last question of somebody who still asks.
constexpr std::chrono::seconds LongestSilence(10);

} // namespace

//------------------------------------------------------------------------------
vtkPVPointFilesReader::vtkPVPointFilesReader() = default;

//------------------------------------------------------------------------------
vtkPVPointFilesReader::~vtkPVPointFilesReader()
{
  this->SetStoreFile(nullptr);
  this->SetAssumedCRS(nullptr);
}

//------------------------------------------------------------------------------
void vtkPVPointFilesReader::AddPointFileName(const char* fileName)
{
  if (fileName && *fileName)
  {
    this->PointFileNames.emplace_back(fileName);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkPVPointFilesReader::RemoveAllPointFileNames()
{
  if (!this->PointFileNames.empty())
  {
    this->PointFileNames.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkPVPointFilesReader::CanReadFile(const char* fileName)
{
  if (!fileName || vtkPointFrontReader::CanReadFile(fileName))
  {
    return 0;
  }
  return pointfront::isPointFile(fileName) ? 1 : 0;
}

//------------------------------------------------------------------------------
std::string vtkPVPointFilesReader::StorePath() const
{
  if (this->StoreFile && *this->StoreFile)
  {
    return this->StoreFile;
  }
  return pointfront::storePathBeside(this->PointFileNames);
}

//------------------------------------------------------------------------------
std::string vtkPVPointFilesReader::Misfit(const std::string& store) const
{
  // A store does not tell all of how it was made: which normals, whose coordinate reference system.
  const bool changed = !this->Shown.empty() &&
    this->Shown.substr(0, this->Shown.find('\n')) == store && this->Shown != this->Wanted(store);
  const std::string seen = this->VisibleMisfit(store);
  return seen.empty() && changed && this->ReplaceStore ? "its options were changed" : seen;
}

//------------------------------------------------------------------------------
std::string vtkPVPointFilesReader::VisibleMisfit(const std::string& store) const
{
  std::error_code failed;
  const auto built = std::filesystem::last_write_time(store, failed);
  if (failed)
  {
    return "it is not there";
  }
  for (const std::string& name : this->PointFileNames)
  {
    if (const auto written = std::filesystem::last_write_time(name, failed);
        !failed && written > built)
    {
      return "it is older than " + name;
    }
  }
  const auto opened = vtkPointFrontStore::GetFormats().open(store);
  if (!opened)
  {
    return opened.error().what;
  }
  const pointfront::StoreDescription& about = opened.value()->description();
  const auto lacks = [&](bool asked, const char* name)
  { return asked && !about.schema.find(name); };
  const bool kd = this->Structure == vtkPointFrontBuilder::KDTREE;
  const bool replaces = this->Refinement == vtkPointFrontBuilder::REPLACE;
  const bool classes = about.layers.size() > 1;
  if (lacks(this->Normals != vtkPointFrontBuilder::NO_NORMALS, "normal"))
  {
    return "it has no normals";
  }
  if (lacks(this->LocalHeight, "local_height"))
  {
    return "it has no local_height";
  }
  if (lacks(this->HeightAboveGround, "height_above_ground"))
  {
    return "it has no height_above_ground";
  }
  if ((about.structure == "kdtree") != kd ||
    (about.refinement == pointfront::Refinement::Replace) != replaces)
  {
    return "it has another Structure or Refinement";
  }
  if (this->Layers == vtkPointFrontBuilder::NO_LAYERS && classes)
  {
    return "it has a tree for each class";
  }
  if (this->Precision > 0.0 &&
    std::abs(about.grid.scale.x - this->Precision) > 1e-9 * this->Precision)
  {
    return "it has another Precision";
  }
  return this->AssumedCRS && *this->AssumedCRS && about.crsWkt.empty()
    ? "it names no coordinate reference system"
    : std::string();
}

//------------------------------------------------------------------------------
void vtkPVPointFilesReader::Choose(vtkPointFrontBuilder* builder, const std::string& store) const
{
  for (const std::string& name : this->PointFileNames)
  {
    builder->AddFileName(name.c_str());
  }
  builder->SetOutputFileName(store.c_str());
  builder->SetOverwrite(this->ReplaceStore);
  builder->SetStructure(this->Structure);
  builder->SetRefinement(this->Refinement);
  builder->SetLayers(this->Layers);
  builder->SetNormals(this->Normals);
  builder->SetLocalHeight(this->LocalHeight);
  builder->SetHeightAboveGround(this->HeightAboveGround);
  builder->SetPrecision(this->Precision);
  builder->SetSkipFaultyFiles(this->SkipFaultyFiles);
  builder->SetAssumedCRS(this->AssumedCRS && *this->AssumedCRS ? this->AssumedCRS : nullptr);
  builder->SetMemoryLimit(static_cast<vtkTypeInt64>(this->MemoryLimitMiB) << 20);
  builder->SetPreview(this->Followed);
  builder->SetPreviewPoints(this->PreviewPoints);
}

//------------------------------------------------------------------------------
std::string vtkPVPointFilesReader::Order(const std::string& store) const
{
  std::ostringstream all;
  all << this->Wanted(store) << '\n' << this->ReplaceStore << ' ' << this->MemoryLimitMiB;
  return all.str();
}

//------------------------------------------------------------------------------
std::string vtkPVPointFilesReader::Wanted(const std::string& store) const
{
  std::ostringstream all;
  all << store << '\n'
      << this->Structure << ' ' << this->Refinement << ' ' << this->Layers << ' ' << this->Normals
      << ' ' << this->LocalHeight << ' ' << this->HeightAboveGround << ' ' << this->Precision << ' '
      << this->SkipFaultyFiles << ' ' << (this->AssumedCRS ? this->AssumedCRS : "");
  for (const std::string& name : this->PointFileNames)
  {
    all << '\n' << name;
  }
  return all.str();
}

//------------------------------------------------------------------------------
bool vtkPVPointFilesReader::StartBuild(const std::string& store)
{
  std::error_code failed;
  if (std::filesystem::exists(store, failed) && !this->ReplaceStore)
  {
    this->SetErrorCode(vtkErrorCode::FileFormatError);
    vtkErrorMacro("the store "
      << store << " does not fit: " << this->Misfit(store)
      << ". Tick Replace Store to build it again, or name another file in Store File.");
    return false;
  }
  const bool asks = this->Asked != std::chrono::steady_clock::time_point() &&
    std::chrono::steady_clock::now() - this->Asked < LongestSilence;
  this->Followed = this->ShowPreview && asks;
  this->Cancelled.clear();
  auto builder = vtkSmartPointer<vtkPointFrontBuilder>::New();
  this->Choose(builder, store);
  this->Running = std::make_unique<pointfront::BackgroundBuild>(builder, this->Order(store));
  return true;
}

//------------------------------------------------------------------------------
vtkPVPointFilesReader::Outcome vtkPVPointFilesReader::EndBuild(
  const pointfront::BackgroundBuild::State& ended, const std::string& store)
{
  if (ended.cancelled)
  {
    // The next render does not begin again a build that was cancelled beside.
    this->Cancelled = this->Previewing ? this->Running->order() : std::string();
  }
  this->Running.reset();
  // Whoever updated may be no view: the views are still to show it. A build that failed would begin
  // again with the update.
  this->Unseen = this->Previewing && (ended.built || ended.cancelled);
  for (const std::string& warning : ended.warnings)
  {
    vtkWarningMacro(<< warning);
  }
  if (!ended.built && !ended.cancelled)
  {
    this->SetErrorCode(ended.errorCode);
    vtkErrorMacro(<< ended.error << " (The store is written to " << store
                  << ": name another place in Store File if that one is not yours to write.)");
  }
  return ended.built ? STORE : NOTHING;
}

//------------------------------------------------------------------------------
vtkPVPointFilesReader::Outcome vtkPVPointFilesReader::BuildOrWait(const std::string& store)
{
  if (this->Running && this->Running->order() != this->Order(store))
  {
    this->Running.reset(); // other properties: another store
  }
  if (!this->Running)
  {
    if (this->Misfit(store).empty())
    {
      return STORE;
    }
    // Asked before it begins: a small build is over before it could be cancelled.
    this->SetProgressText("building the store");
    this->UpdateProgress(0.0);
    if (this->CheckAbort() || this->GetAbortExecute() || this->Cancelled == this->Order(store) ||
      !this->StartBuild(store))
    {
      return NOTHING;
    }
  }
  pointfront::BackgroundBuild::State state = this->Running->state();
  while (!state.ended && !(this->Followed && state.preview))
  {
    state = this->Running->waitFor(std::chrono::milliseconds(100));
    this->SetProgressText(state.phase.c_str());
    this->UpdateProgress(state.fraction);
    // The application sets these while it shows progress.
    if (this->CheckAbort() || this->GetAbortExecute())
    {
      this->Running->cancel();
    }
  }
  return state.ended ? this->EndBuild(state, store) : PREVIEW;
}

//------------------------------------------------------------------------------
vtkPVPointFilesReader::Outcome vtkPVPointFilesReader::Agree(const std::string& store)
{
  // All ranks do the same, whatever each has seen of the disk.
  auto* controller = vtkMultiProcessController::GetGlobalController();
  int outcome = NOTHING;
  if (!controller || controller->GetLocalProcessId() == 0)
  {
    outcome = this->BuildOrWait(store);
  }
  if (controller && controller->GetNumberOfProcesses() > 1)
  {
    controller->Broadcast(&outcome, 1, 0);
  }
  return static_cast<Outcome>(outcome);
}

//------------------------------------------------------------------------------
bool vtkPVPointFilesReader::GetNeedsUpdate()
{
  this->Asked = std::chrono::steady_clock::now();
  return std::exchange(this->Unseen, false) || (this->Running && this->Running->state().ended);
}

//------------------------------------------------------------------------------
void vtkPVPointFilesReader::CancelBuild()
{
  if (this->Running)
  {
    this->Running->cancel();
  }
}

//------------------------------------------------------------------------------
void vtkPVPointFilesReader::CloseStore()
{
  this->Running.reset();
  this->Previewing = false;
  this->Superclass::CloseStore();
}

//------------------------------------------------------------------------------
std::string vtkPVPointFilesReader::GetBuildState() const
{
  if (!this->Running)
  {
    return {};
  }
  const pointfront::BackgroundBuild::State state = this->Running->state();
  return state.phase + ", " + std::to_string(std::lround(100.0 * state.fraction)) + " %";
}

//------------------------------------------------------------------------------
vtkMTimeType vtkPVPointFilesReader::GetMTime()
{
  if (this->Previewing)
  {
    this->Looked.Modified();
  }
  return std::max(this->Superclass::GetMTime(), this->Looked.GetMTime());
}

//------------------------------------------------------------------------------
int vtkPVPointFilesReader::RequestInformation(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (this->PointFileNames.empty())
  {
    this->FileNames.clear();
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    vtkErrorMacro("no file names: add the point files to read");
    return 1;
  }
  const std::string store = this->StorePath();
  if (!this->Previewing && this->Misfit(store).empty())
  {
    this->FileNames.assign(1, store);
    return this->Superclass::RequestInformation(request, inputs, outputs);
  }
  if (!this->Previewing)
  {
    this->FileNames.clear();
    this->Store = nullptr;
  }
  outputs->GetInformationObject(0)->Set(vtkAlgorithm::CAN_HANDLE_PIECE_REQUEST(), 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkPVPointFilesReader::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  if (this->PointFileNames.empty())
  {
    return 1; // has been said
  }
  const std::string store = this->StorePath();
  const Outcome outcome = this->Agree(store);
  this->Previewing = outcome == PREVIEW;
  if (outcome == STORE)
  {
    this->Shown = this->Wanted(store);
  }
  if (outcome == NOTHING)
  {
    this->FileNames.clear();
    this->Store = nullptr;
    return 1; // aborted, or the first rank has said why
  }
  const std::string shown = this->Previewing ? pointfront::previewPathOf(store) : store;
  if (!this->Store || this->FileNames != std::vector<std::string>{ shown })
  {
    this->FileNames.assign(1, shown);
    this->Superclass::RequestInformation(request, inputs, outputs);
  }
  return this->Superclass::RequestData(request, inputs, outputs);
}

//------------------------------------------------------------------------------
void vtkPVPointFilesReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PointFileNames: " << this->PointFileNames.size() << "\n"
     << indent << "StoreFile: " << (this->StoreFile ? this->StoreFile : "(beside the first file)")
     << "\n"
     << indent << "ReplaceStore: " << this->ReplaceStore << "\n";
}
