#include "vtkPointFrontBuilder.h"

#include "BuildThread.h"

#include "pointfront/Store/PreviewRecord.h"

#include <vtkCommand.h>
#include <vtkErrorCode.h>
#include <vtkIndent.h>
#include <vtkObjectFactory.h>

#include <algorithm>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkPointFrontBuilder);

namespace
{

unsigned long errorCodeOf(pointfront::Error::Kind kind)
{
  using Kind = pointfront::Error::Kind;
  switch (kind)
  {
    case Kind::NotFound:
      return vtkErrorCode::FileNotFoundError;
    case Kind::Unreadable:
    case Kind::Unwritable:
      return vtkErrorCode::CannotOpenFileError;
    case Kind::BadFormat:
    case Kind::Corrupt:
      return vtkErrorCode::FileFormatError;
    case Kind::Truncated:
      return vtkErrorCode::PrematureEndOfFileError;
    case Kind::Unsupported:
      return vtkErrorCode::UnrecognizedFileTypeError;
    case Kind::Cancelled:
      return vtkErrorCode::UserError;
    case Kind::BadArgument:
    case Kind::NoMemory:
      break;
  }
  return vtkErrorCode::UnknownError;
}

} // namespace

struct vtkPointFrontBuilder::Content
{
  std::vector<std::string> FileNames;
  std::string PreviewFileName;
  std::string Phase;
  double PhaseBegan = 0.0;       // seconds into the build
  std::uint64_t PhaseDone = 0;   // points at that time
};

vtkPointFrontBuilder::vtkPointFrontBuilder() : Internals(new Content)
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(0);
}

vtkPointFrontBuilder::~vtkPointFrontBuilder()
{
  this->SetOutputFileName(nullptr);
  this->SetTemporaryFolder(nullptr);
}

void vtkPointFrontBuilder::AddFileName(const char* fileName)
{
  if (fileName && *fileName)
  {
    this->Internals->FileNames.emplace_back(fileName);
    this->Modified();
  }
}

void vtkPointFrontBuilder::ClearFileNames()
{
  this->Internals->FileNames.clear();
  this->Modified();
}

int vtkPointFrontBuilder::GetNumberOfFileNames()
{
  return static_cast<int>(this->Internals->FileNames.size());
}

const char* vtkPointFrontBuilder::GetFileName(int index)
{
  const std::vector<std::string>& names = this->Internals->FileNames;
  return index >= 0 && index < this->GetNumberOfFileNames()
    ? names[static_cast<std::size_t>(index)].c_str()
    : nullptr;
}

const char* vtkPointFrontBuilder::GetPreviewFileName()
{
  this->Internals->PreviewFileName =
    this->OutputFileName ? pointfront::previewPathOf(this->OutputFileName) : std::string();
  return this->Internals->PreviewFileName.c_str();
}

int vtkPointFrontBuilder::Write()
{
  this->SetErrorCode(vtkErrorCode::NoError);
  if (!this->OutputFileName || !*this->OutputFileName || this->Internals->FileNames.empty())
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    vtkErrorMacro("no file names: add the point files to read and set OutputFileName");
    return 0;
  }
  pointfront::BuildOptions options;
  options.outputPath = this->OutputFileName;
  options.temporaryFolder = this->TemporaryFolder ? this->TemporaryFolder : "";
  options.overwrite = this->Overwrite;
  options.memoryBytes = static_cast<std::uint64_t>(this->MemoryLimit);
  options.threads = static_cast<unsigned>(this->NumberOfThreads);
  options.nodePoints = static_cast<std::uint32_t>(this->NodePoints);
  if (this->Precision > 0.0)
  {
    options.precision = this->Precision;
  }
  pointfront::PreviewOptions preview;
  preview.wanted = this->Preview;
  preview.leastPoints = static_cast<std::uint64_t>(this->PreviewPoints);
  std::vector<std::string> files = this->Internals->FileNames;
  std::sort(files.begin(), files.end());

  this->SetAbortExecute(0);
  this->Internals->Phase.clear();
  const auto watch = [this](const pointfront::BuildThread::News& news)
  {
    const pointfront::Progress& state = news.progress;
    Content& content = *this->Internals;
    if (content.Phase != state.phase)
    {
      content.Phase = state.phase;
      content.PhaseBegan = state.secondsElapsed;
      content.PhaseDone = state.done;
      this->SetProgressText(state.phase);
    }
    const double seconds = state.secondsElapsed - content.PhaseBegan;
    this->PointsDone = static_cast<vtkIdType>(state.done);
    this->PointsTotal = static_cast<vtkIdType>(state.total);
    this->PointsPerSecond =
      seconds > 0.0 ? static_cast<double>(state.done - content.PhaseDone) / seconds : 0.0;
    const double leastFraction = 0.02; // the first moments say nothing about the rest
    this->SecondsRemaining = state.fraction < leastFraction
      ? -1.0
      : state.secondsElapsed * (1.0 - state.fraction) / state.fraction;
    this->UpdateProgress(state.fraction);
    if (news.preview)
    {
      this->InvokeEvent(vtkCommand::UpdateDataEvent);
    }
    this->InvokeEvent(vtkCommand::AbortCheckEvent);
    return this->GetAbortExecute() == 0;
  };
  this->InvokeEvent(vtkCommand::StartEvent);
  const auto report = pointfront::BuildThread().run(files, options, preview, watch);
  this->InvokeEvent(vtkCommand::EndEvent);
  if (!report)
  {
    this->SetErrorCode(errorCodeOf(report.error().kind));
    if (report.error().kind != pointfront::Error::Kind::Cancelled)
    {
      vtkErrorMacro(<< report.error().what);
    }
    return 0;
  }
  const pointfront::BuildReport& built = report.value();
  for (const std::string& warning : built.warnings)
  {
    vtkWarningMacro(<< warning);
  }
  this->NumberOfPointsRead = static_cast<vtkIdType>(built.pointsRead);
  this->NumberOfPointsStored = static_cast<vtkIdType>(built.pointsStored);
  this->NumberOfNodes = static_cast<vtkIdType>(built.nodes);
  this->BytesWritten = static_cast<vtkTypeInt64>(built.bytesWritten);
  this->BytesSpilled = static_cast<vtkTypeInt64>(built.spilledBytes);
  this->UpdateProgress(1.0);
  return 1;
}

void vtkPointFrontBuilder::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileNames: " << this->GetNumberOfFileNames() << "\n";
  os << indent << "OutputFileName: " << (this->OutputFileName ? this->OutputFileName : "(none)")
     << "\n";
  os << indent << "Overwrite: " << this->Overwrite << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "NodePoints: " << this->NodePoints << "\n";
  os << indent << "Precision: " << this->Precision << "\n";
  os << indent << "Preview: " << this->Preview << "\n";
}
