#include "vtkPVPointFileWriter.h"

#include "LASWriter.h"
#include "PointSetSource.h"

#include "pointfront/Base/LetterCase.h"
#include "pointfront/Export/OutputTarget.h"
#include "pointfront/Export/SourceExport.h"
#include "pointfront/Export/SourceSurvey.h"

#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"

#include <memory>
#include <optional>
#include <string>

vtkStandardNewMacro(vtkPVPointFileWriter);

namespace
{

} // namespace

//------------------------------------------------------------------------------
vtkPVPointFileWriter::vtkPVPointFileWriter() = default;

//------------------------------------------------------------------------------
vtkPVPointFileWriter::~vtkPVPointFileWriter()
{
  this->SetFileName(nullptr);
}

//------------------------------------------------------------------------------
int vtkPVPointFileWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkPointSet");
  return 1;
}

//------------------------------------------------------------------------------
void vtkPVPointFileWriter::Fail(const std::string& why, bool cancelled)
{
  this->SetErrorCode(vtkErrorCode::UserError);
  if (!cancelled)
  {
    vtkErrorMacro(<< why);
  }
}

//------------------------------------------------------------------------------
void vtkPVPointFileWriter::WriteData()
{
  const std::string path = this->FileName ? this->FileName : "";
  const std::string ending = pointfront::loweredExtension(path);
  if (ending != ".las" && ending != ".laz")
  {
    this->Fail("\"" + path + "\" is no name of a LAS or LAZ file: it ends in .las or .laz");
    return;
  }
  const pointfront::OutputTarget target{ path, pointfront::FileKind::LAS, true };
  if (const auto free = pointfront::checkOutputTarget(target); !free)
  {
    this->Fail(free.error().what);
    return;
  }
  auto source = pointfront::PointSetSource::make(vtkPointSet::SafeDownCast(this->GetInput()));
  if (!source)
  {
    this->Fail(source.error().what);
    return;
  }
  const std::shared_ptr<const pointfront::PointSetSource> points = std::move(*source);
  for (const std::string& warning : points->description().warnings)
  {
    vtkWarningMacro(<< warning);
  }
  const auto told = pointfront::surveyed(
    points, this->Precision > 0.0 ? std::optional<double>(this->Precision) : std::nullopt);
  if (!told)
  {
    this->Fail(told.error().what);
    return;
  }
  const auto progress = [this](const pointfront::Progress& state)
  {
    this->UpdateProgress(state.fraction);
    return !this->GetAbortExecute();
  };
  pointfront::LASWriter file(path,
    ending == ".laz" ? pointfront::LASWriter::Encoding::Laz : pointfront::LASWriter::Encoding::Las);
  if (const auto written = pointfront::exportSource(*points, *told, file, progress); !written)
  {
    this->Fail(written.error().what, written.error().kind == pointfront::Error::Kind::Cancelled);
    return;
  }
  for (const std::string& finding : file.findings())
  {
    vtkWarningMacro(<< finding);
  }
}

//------------------------------------------------------------------------------
void vtkPVPointFileWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n"
     << indent << "Precision: " << this->Precision << "\n";
}
