#include "vtkPointFrontLASIndexer.h"

#include "InterpreterPause.h"
#include "LASIndexing.h"

#include <vtkCommand.h>
#include <vtkIndent.h>
#include <vtkObjectFactory.h>

#include <string>
#include <thread>

vtkStandardNewMacro(vtkPointFrontLASIndexer);

vtkPointFrontLASIndexer::~vtkPointFrontLASIndexer()
{
  this->SetFileName(nullptr);
  this->SetIndexFileName(nullptr);
}

bool vtkPointFrontLASIndexer::Index()
{
  this->NumberOfPoints = 0;
  this->Abort = false;
  if (!this->FileName || !*this->FileName)
  {
    vtkErrorMacro("no file name: set FileName to a LAS file");
    return false;
  }
  const std::string side = this->IndexFileName && *this->IndexFileName
    ? std::string(this->IndexFileName)
    : std::string(this->FileName) + pointfront::lasIndexSuffix;
  pointfront::LASIndexOptions options;
  options.leafPoints = static_cast<std::uint32_t>(this->NodePoints);
  options.overwrite = this->Overwrite;
  // Observers are called in the caller's thread only: what other threads report is left out.
  const std::thread::id caller = std::this_thread::get_id();
  pointfront::InterpreterPause pause;
  const auto report = pointfront::indexLASFile(this->FileName, side, options,
    [this, caller, &pause](const pointfront::Progress& progress)
    {
      if (std::this_thread::get_id() == caller)
      {
        const pointfront::InterpreterPause::Resumed resumed(pause);
        double fraction = progress.fraction;
        this->InvokeEvent(vtkCommand::ProgressEvent, &fraction);
        return !this->Abort && !resumed.interrupted();
      }
      return true;
    });
  const pointfront::InterpreterPause::Resumed resumed(pause);
  if (!report)
  {
    if (report.error().kind != pointfront::Error::Kind::Cancelled)
    {
      vtkErrorMacro(<< report.error().what);
    }
    return false;
  }
  for (const std::string& warning : report->warnings)
  {
    vtkWarningMacro(<< this->FileName << ": " << warning);
  }
  this->NumberOfPoints = static_cast<vtkIdType>(report->points);
  return true;
}

void vtkPointFrontLASIndexer::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << (this->FileName ? this->FileName : "(none)") << "\n";
  os << indent << "IndexFileName: " << (this->IndexFileName ? this->IndexFileName : "(none)")
     << "\n";
  os << indent << "Overwrite: " << this->Overwrite << "\n";
  os << indent << "NodePoints: " << this->NodePoints << "\n";
  os << indent << "Abort: " << this->Abort << "\n";
  os << indent << "NumberOfPoints: " << this->NumberOfPoints << "\n";
}
