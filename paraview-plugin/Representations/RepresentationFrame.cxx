/// The part of vtkPointFrontRepresentation that tells of this process's last frame.

#include "vtkPointFrontRepresentation.h"

#include "UpstreamReader.h"
#include "vtkPVPointFilesReader.h"

#include "vtkPointFrontMapper.h"
#include "vtkPointFrontStore.h"
#include "vtkScalarsToColors.h"

//------------------------------------------------------------------------------
bool vtkPointFrontRepresentation::IsDrawing()
{
  return this->GetVisibility() && this->GetView() && this->Mapper->GetStore();
}

//------------------------------------------------------------------------------
vtkIdType vtkPointFrontRepresentation::GetPointsDrawn()
{
  return this->IsDrawing() ? this->Mapper->GetLastPointsDrawn() : 0;
}

//------------------------------------------------------------------------------
vtkIdType vtkPointFrontRepresentation::GetNodesDrawn()
{
  return this->IsDrawing() ? this->Mapper->GetLastNodesDrawn() : 0;
}

//------------------------------------------------------------------------------
double vtkPointFrontRepresentation::GetProjectedSpacing()
{
  return this->IsDrawing() ? this->Mapper->GetLastError() : 0.0;
}

//------------------------------------------------------------------------------
std::string vtkPointFrontRepresentation::GetTechniqueDrawn()
{
  const bool draws = this->IsDrawing() && this->Mapper->GetLastPointsDrawn() > 0;
  return draws ? this->Mapper->GetLastTechnique() : std::string();
}

//------------------------------------------------------------------------------
vtkIdType vtkPointFrontRepresentation::GetStorePoints()
{
  return this->IsDrawing() ? this->Mapper->GetStore()->GetNumberOfPoints() : 0;
}

//------------------------------------------------------------------------------
int vtkPointFrontRepresentation::GetFrameLimits()
{
  if (!this->IsDrawing())
  {
    return 0;
  }
  const auto bit = [](bool set, int value) { return set ? value : 0; };
  const bool points = this->Mapper->GetLastLimitedByPoints();
  return bit(points && !this->InMotion, POINT_BUDGET) | bit(points && this->InMotion, FRAME_TIME) |
    bit(this->Mapper->GetLastLimitedByGPUMemory(), GPU_MEMORY) |
    bit(this->Mapper->GetLastLimitedByMemory(), HOST_MEMORY) |
    bit(!this->Mapper->GetLastComplete(), LOADING) |
    bit(this->Mapper->GetLastFailedNodes() > 0, UNREADABLE);
}

//------------------------------------------------------------------------------
bool vtkPointFrontRepresentation::GetFrameComplete()
{
  return !this->IsDrawing() || (this->Mapper->GetLastComplete() && this->GetBuildState().empty());
}

//------------------------------------------------------------------------------
std::string vtkPointFrontRepresentation::GetBuildState()
{
  auto* files = vtkPVPointFilesReader::SafeDownCast(pointfront::upstreamReaderOf(this));
  return files ? files->GetBuildState() : std::string();
}

//------------------------------------------------------------------------------
bool vtkPointFrontRepresentation::GetFrameOutdated()
{
  return this->IsDrawing() && this->Mapper->NeedsRender();
}
