#include "vtkPointFrontBuilder.h"

#include "BuildThread.h"
#include "InterpreterPause.h"
#include "PointSetSource.h"

#include "pointfront/Store/PreviewRecord.h"

#include <vtkCommand.h>
#include <vtkErrorCode.h>
#include <vtkIndent.h>
#include <vtkObjectFactory.h>
#include <vtkPointSet.h>
#include <vtkSmartPointer.h>

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
  vtkSmartPointer<vtkPointSet> Points;
  std::vector<std::string> Attributes;
  std::vector<int> NormalsClasses;
  std::vector<std::string> ColorImages;
  std::vector<std::string> AttributeImages; // NAME=IMAGE
  std::string PreviewFileName;
  std::string Phase;
  double PhaseBegan = 0.0; // seconds into the build
  std::uint64_t PhaseDone = 0; // points at that time

  pointfront::BuildOrder Order(const vtkPointFrontBuilder& builder) const;
  void Choose(const vtkPointFrontBuilder& builder, pointfront::PassChoice& choice) const;
  void Show(vtkPointFrontBuilder& builder, const pointfront::Progress& state);
  static void Report(vtkPointFrontBuilder& builder, const pointfront::BuildReport& built);
};

pointfront::BuildOrder vtkPointFrontBuilder::Content::Order(
  const vtkPointFrontBuilder& builder) const
{
  pointfront::BuildOrder order;
  order.files = this->FileNames;
  std::sort(order.files.begin(), order.files.end());
  if (this->Points)
  {
    const auto threads = static_cast<unsigned>(builder.NumberOfThreads);
    order.made = [this, threads]() -> pointfront::Result<pointfront::PointSources>
    {
      auto source = pointfront::PointSetSource::make(this->Points, { threads, {} });
      if (!source)
      {
        return source.error();
      }
      pointfront::PointSources sources;
      sources.push_back(std::move(*source));
      return sources;
    };
  }
  pointfront::BuildOptions& options = order.options;
  options.outputPath = builder.OutputFileName;
  options.temporaryFolder = builder.TemporaryFolder ? builder.TemporaryFolder : "";
  options.overwrite = builder.Overwrite;
  options.onFault = builder.SkipFaultyFiles ? pointfront::OnFault::Skip : pointfront::OnFault::Stop;
  options.memoryBytes = static_cast<std::uint64_t>(builder.MemoryLimit);
  options.threads = static_cast<unsigned>(builder.NumberOfThreads);
  options.nodePoints = static_cast<std::uint32_t>(builder.NodePoints);
  options.structure =
    builder.Structure == KDTREE ? pointfront::Structure::KdTree : pointfront::Structure::Octree;
  options.refinement =
    builder.Refinement == REPLACE ? pointfront::Refinement::Replace : pointfront::Refinement::Add;
  options.layering = builder.Layers == BY_CLASS ? pointfront::Layering::ObjectClass
    : builder.Layers == NO_LAYERS               ? pointfront::Layering::None
                                                : pointfront::Layering::Automatic;
  options.colourDepth = builder.ColorDepth == 8 ? pointfront::ColourDepth::Eight
    : builder.ColorDepth == 16                  ? pointfront::ColourDepth::Sixteen
                                                : pointfront::ColourDepth::ByFile;
  if (builder.Precision > 0.0)
  {
    options.precision = builder.Precision;
  }
  if (builder.UseBox)
  {
    const double* const box = builder.Box;
    order.box.emplace();
    order.box->low = { box[0], box[2], box[4] };
    order.box->high = { box[1], box[3], box[5] };
  }
  if (!this->Attributes.empty())
  {
    options.attributes = this->Attributes;
  }
  this->Choose(builder, order.passes);
  order.preview.wanted = builder.Preview;
  order.preview.leastPoints = static_cast<std::uint64_t>(builder.PreviewPoints);
  return order;
}

void vtkPointFrontBuilder::Content::Choose(
  const vtkPointFrontBuilder& builder, pointfront::PassChoice& choice) const
{
  using Normals = pointfront::PassChoice::Normals;
  choice.targetCrs = builder.CRS ? builder.CRS : "";
  choice.assumedCrs = builder.AssumedCRS ? builder.AssumedCRS : "";
  choice.targetCrsName = "CRS";
  choice.assumedCrsName = "AssumedCRS";
  choice.inputsMayNameCrs = !this->Points;
  choice.colourFrom = this->ColorImages;
  choice.attributeFrom = this->AttributeImages;
  choice.normals = builder.Normals == PCA ? Normals::PCA
    : builder.Normals == SCAN_LINE        ? Normals::ScanLine
                                          : Normals::None;
  choice.normalsNeighbours = static_cast<std::uint32_t>(std::max(0, builder.NormalsNeighbors));
  choice.normalsRadius = builder.NormalsRadius;
  choice.normalsEps = builder.NormalsError;
  choice.curvature = builder.Curvature;
  choice.splatRadius = builder.SplatRadius;
  if (!this->NormalsClasses.empty())
  {
    choice.normalsClasses.emplace(this->NormalsClasses.begin(), this->NormalsClasses.end());
    std::sort(choice.normalsClasses->begin(), choice.normalsClasses->end());
  }
  choice.localHeight = builder.LocalHeight;
  choice.localHeightRadius = builder.LocalHeightRadius;
  choice.heightAboveGround = builder.HeightAboveGround;
  choice.groundCell = builder.GroundCell;
}

/// Sets what observers of ProgressEvent ask for, then calls them.
void vtkPointFrontBuilder::Content::Show(
  vtkPointFrontBuilder& builder, const pointfront::Progress& state)
{
  if (this->Phase != state.phase)
  {
    this->Phase = state.phase;
    this->PhaseBegan = state.secondsElapsed;
    this->PhaseDone = state.done;
    builder.SetProgressText(state.phase);
  }
  const double seconds = state.secondsElapsed - this->PhaseBegan;
  builder.PointsDone = static_cast<vtkIdType>(state.done);
  builder.PointsTotal = static_cast<vtkIdType>(state.total);
  builder.PointsPerSecond =
    seconds > 0.0 ? static_cast<double>(state.done - this->PhaseDone) / seconds : 0.0;
  const double leastFraction = 0.02; // the first moments say nothing about the rest
  builder.SecondsRemaining = state.fraction < leastFraction
    ? -1.0
    : state.secondsElapsed * (1.0 - state.fraction) / state.fraction;
  builder.UpdateProgress(state.fraction);
}

void vtkPointFrontBuilder::Content::Report(
  vtkPointFrontBuilder& builder, const pointfront::BuildReport& built)
{
  for (const std::string& warning : built.warnings)
  {
    vtkWarningWithObjectMacro(&builder, << warning);
  }
  for (const pointfront::InputFault& skipped : built.inputsSkipped)
  {
    vtkWarningWithObjectMacro(&builder, << skipped.path << " is skipped: " << skipped.why);
  }
  builder.NumberOfFilesSkipped = static_cast<int>(built.inputsSkipped.size());
  builder.NumberOfPointsRejected = static_cast<vtkIdType>(built.pointsRead - built.pointsStored);
  builder.NumberOfPointsOutside = static_cast<vtkIdType>(built.pointsOutside);
  builder.NumberOfPointsRead = static_cast<vtkIdType>(built.pointsRead);
  builder.NumberOfPointsStored = static_cast<vtkIdType>(built.pointsStored);
  builder.NumberOfNodes = static_cast<vtkIdType>(built.nodes);
  builder.BytesWritten = static_cast<vtkTypeInt64>(built.bytesWritten);
  builder.BytesSpilled = static_cast<vtkTypeInt64>(built.spilledBytes);
}

vtkPointFrontBuilder::vtkPointFrontBuilder()
  : Internals(new Content)
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(0);
}

vtkPointFrontBuilder::~vtkPointFrontBuilder()
{
  this->SetOutputFileName(nullptr);
  this->SetTemporaryFolder(nullptr);
  this->SetCRS(nullptr);
  this->SetAssumedCRS(nullptr);
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

void vtkPointFrontBuilder::SetPoints(vtkPointSet* points)
{
  if (this->Internals->Points != points)
  {
    this->Internals->Points = points;
    this->Modified();
  }
}

vtkPointSet* vtkPointFrontBuilder::GetPoints()
{
  return this->Internals->Points;
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

void vtkPointFrontBuilder::AddAttribute(const char* name)
{
  if (name && *name)
  {
    this->Internals->Attributes.emplace_back(name);
    this->Modified();
  }
}

void vtkPointFrontBuilder::ClearAttributes()
{
  this->Internals->Attributes.clear();
  this->Modified();
}

void vtkPointFrontBuilder::AddNormalsClass(int objectClass)
{
  this->Internals->NormalsClasses.push_back(objectClass);
  this->Modified();
}

void vtkPointFrontBuilder::ClearNormalsClasses()
{
  this->Internals->NormalsClasses.clear();
  this->Modified();
}

void vtkPointFrontBuilder::AddColorImage(const char* fileName)
{
  if (fileName && *fileName)
  {
    this->Internals->ColorImages.emplace_back(fileName);
    this->Modified();
  }
}

void vtkPointFrontBuilder::AddAttributeImage(const char* attribute, const char* fileName)
{
  if (attribute && fileName && *fileName)
  {
    this->Internals->AttributeImages.push_back(std::string(attribute) + "=" + fileName);
    this->Modified();
  }
}

void vtkPointFrontBuilder::ClearImages()
{
  this->Internals->ColorImages.clear();
  this->Internals->AttributeImages.clear();
  this->Modified();
}

/// Checks values that the kernel's types cannot even express; the kernel checks the rest.
bool vtkPointFrontBuilder::CheckProperties()
{
  const bool files = !this->Internals->FileNames.empty();
  if (files && this->Internals->Points)
  {
    this->SetErrorCode(vtkErrorCode::UnknownError);
    vtkErrorMacro("both file names and Points are set: a store is built from the one or the other");
    return false;
  }
  if (!this->OutputFileName || !*this->OutputFileName || (!files && !this->Internals->Points))
  {
    this->SetErrorCode(vtkErrorCode::NoFileNameError);
    vtkErrorMacro("no file names: add the point files to read and set OutputFileName");
    return false;
  }
  if (this->ColorDepth != 0 && this->ColorDepth != 8 && this->ColorDepth != 16)
  {
    this->SetErrorCode(vtkErrorCode::UnknownError);
    vtkErrorMacro("a ColorDepth of " << this->ColorDepth << " bits is none of 0, 8 and 16");
    return false;
  }
  for (const int objectClass : this->Internals->NormalsClasses)
  {
    if (objectClass < 0 || objectClass > 255)
    {
      this->SetErrorCode(vtkErrorCode::UnknownError);
      vtkErrorMacro("a class " << objectClass << " for normals is none of 0 to 255");
      return false;
    }
  }
  return true;
}

int vtkPointFrontBuilder::Write()
{
  this->SetErrorCode(vtkErrorCode::NoError);
  if (!this->CheckProperties())
  {
    return 0;
  }
  Content& content = *this->Internals;
  this->SetAbortExecute(0);
  content.Phase.clear();
  this->InvokeEvent(vtkCommand::StartEvent);
  pointfront::InterpreterPause pause;
  const auto watch = [this, &content, &pause](const pointfront::BuildThread::News& news)
  {
    const pointfront::InterpreterPause::Resumed resumed(pause);
    content.Show(*this, news.progress);
    if (news.preview)
    {
      this->InvokeEvent(vtkCommand::UpdateDataEvent);
    }
    this->InvokeEvent(vtkCommand::AbortCheckEvent);
    return this->GetAbortExecute() == 0 && !resumed.interrupted();
  };
  const auto report = pointfront::BuildThread().run(content.Order(*this), watch);
  const pointfront::InterpreterPause::Resumed resumed(pause);
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
  Content::Report(*this, report.value());
  this->UpdateProgress(1.0);
  return 1;
}

void vtkPointFrontBuilder::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileNames: " << this->GetNumberOfFileNames() << "\n";
  os << indent << "Points: " << (this->GetPoints() ? "set" : "(none)") << "\n";
  os << indent << "OutputFileName: " << (this->OutputFileName ? this->OutputFileName : "(none)")
     << "\n";
  os << indent << "Overwrite: " << this->Overwrite << "\n";
  os << indent << "SkipFaultyFiles: " << this->SkipFaultyFiles << "\n";
  os << indent << "MemoryLimit: " << this->MemoryLimit << "\n";
  os << indent << "NumberOfThreads: " << this->NumberOfThreads << "\n";
  os << indent << "NodePoints: " << this->NodePoints << "\n";
  os << indent << "Precision: " << this->Precision << "\n";
  os << indent << "UseBox: " << this->UseBox << "\n";
  os << indent << "Box:";
  for (const double end : this->Box)
  {
    os << " " << end;
  }
  os << "\n";
  os << indent << "Structure: " << (this->Structure == KDTREE ? "kd-tree" : "octree") << "\n";
  os << indent << "Refinement: " << (this->Refinement == REPLACE ? "replace" : "add") << "\n";
  os << indent << "Layers: " << this->Layers << "\n";
  os << indent << "Attributes: " << this->Internals->Attributes.size() << " named\n";
  os << indent << "ColorDepth: " << this->ColorDepth << "\n";
  os << indent << "CRS: " << (this->CRS ? this->CRS : "(none)") << "\n";
  os << indent << "AssumedCRS: " << (this->AssumedCRS ? this->AssumedCRS : "(none)") << "\n";
  os << indent << "Normals: " << this->Normals << "\n";
  os << indent << "NormalsNeighbors: " << this->NormalsNeighbors << "\n";
  os << indent << "NormalsRadius: " << this->NormalsRadius << "\n";
  os << indent << "NormalsError: " << this->NormalsError << "\n";
  os << indent << "Curvature: " << this->Curvature << "\n";
  os << indent << "SplatRadius: " << this->SplatRadius << "\n";
  os << indent << "LocalHeight: " << this->LocalHeight << "\n";
  os << indent << "LocalHeightRadius: " << this->LocalHeightRadius << "\n";
  os << indent << "HeightAboveGround: " << this->HeightAboveGround << "\n";
  os << indent << "GroundCell: " << this->GroundCell << "\n";
  os << indent << "ColorImages: " << this->Internals->ColorImages.size() << "\n";
  os << indent << "AttributeImages: " << this->Internals->AttributeImages.size() << "\n";
  os << indent << "Preview: " << this->Preview << "\n";
}
