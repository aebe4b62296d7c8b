#include "vtkPVPointFrontFrame.h"

#include "StoreFacts.h"

#include "pointfront/Base/NumberText.h"
#include "pointfront/Quality/QualityCurve.h"

#include "vtkClientServerStream.h"
#include "vtkObjectFactory.h"
#include "vtkPointFrontRepresentation.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <utility>

vtkStandardNewMacro(vtkPVPointFrontFrame);

//------------------------------------------------------------------------------
vtkPVPointFrontFrame::vtkPVPointFrontFrame() = default;

//------------------------------------------------------------------------------
vtkPVPointFrontFrame::~vtkPVPointFrontFrame() = default;

//------------------------------------------------------------------------------
void vtkPVPointFrontFrame::CopyFromObject(vtkObject* object)
{
  auto* representation = vtkPointFrontRepresentation::SafeDownCast(object);
  if (!representation)
  {
    vtkErrorMacro("A vtkPointFrontRepresentation is asked for its frame, not "
      << (object ? object->GetClassName() : "nothing"));
    return;
  }
  this->PointsDrawn = representation->GetPointsDrawn();
  this->StorePoints = representation->GetStorePoints();
  this->NodesDrawn = representation->GetNodesDrawn();
  this->ProjectedSpacing = representation->GetProjectedSpacing();
  this->HostMemoryBudget = representation->GetHostMemoryBudget();
  this->Limits = representation->GetFrameLimits();
  this->Complete = representation->GetFrameComplete();
  this->Outdated = representation->GetFrameOutdated();
  this->Build = representation->GetBuildState();
  this->Technique = representation->GetTechniqueDrawn();
  this->MissingNodes = representation->GetMissingNodes();
  this->Traffic = pointfront::ByteTraffic::ofProcess().counts();
}

//------------------------------------------------------------------------------
void vtkPVPointFrontFrame::AddInformation(vtkPVInformation* information)
{
  if (auto* other = vtkPVPointFrontFrame::SafeDownCast(information))
  {
    this->PointsDrawn += other->PointsDrawn;
    this->StorePoints = std::max(this->StorePoints, other->StorePoints);
    this->NodesDrawn += other->NodesDrawn;
    this->ProjectedSpacing = std::max(this->ProjectedSpacing, other->ProjectedSpacing);
    // 0: the client, before anything was added to it.
    this->HostMemoryBudget = this->HostMemoryBudget > 0
      ? std::min(this->HostMemoryBudget, other->HostMemoryBudget)
      : other->HostMemoryBudget;
    this->Limits |= other->Limits;
    this->MissingNodes += other->MissingNodes;
    this->Traffic.requests += other->Traffic.requests;
    this->Traffic.bytes += other->Traffic.bytes;
    this->Traffic.cacheHits += other->Traffic.cacheHits;
    this->Traffic.cacheBytes += other->Traffic.cacheBytes;
    this->Complete = this->Complete && other->Complete;
    this->Outdated = this->Outdated || other->Outdated;
    this->Build = this->Build.empty() ? other->Build : this->Build;
    this->Technique = this->Technique.empty() ? other->Technique : this->Technique;
  }
}

//------------------------------------------------------------------------------
void vtkPVPointFrontFrame::CopyToStream(vtkClientServerStream* stream)
{
  stream->Reset();
  *stream << vtkClientServerStream::Reply << static_cast<vtkTypeInt64>(this->PointsDrawn)
          << static_cast<vtkTypeInt64>(this->NodesDrawn) << this->ProjectedSpacing
          << (this->Complete ? 1 : 0) << (this->Outdated ? 1 : 0) << this->HostMemoryBudget
          << this->Limits << static_cast<vtkTypeInt64>(this->StorePoints) << this->Build
          << this->Technique << static_cast<vtkTypeInt64>(this->MissingNodes)
          << static_cast<vtkTypeUInt64>(this->Traffic.requests)
          << static_cast<vtkTypeUInt64>(this->Traffic.bytes)
          << static_cast<vtkTypeUInt64>(this->Traffic.cacheHits)
          << static_cast<vtkTypeUInt64>(this->Traffic.cacheBytes) << vtkClientServerStream::End;
}

//------------------------------------------------------------------------------
void vtkPVPointFrontFrame::CopyFromStream(const vtkClientServerStream* stream)
{
  vtkTypeInt64 points = 0;
  vtkTypeInt64 nodes = 0;
  vtkTypeInt64 all = 0;
  int complete = 1;
  int outdated = 0;
  std::string build;
  std::string technique;
  vtkTypeInt64 missing = 0;
  vtkTypeUInt64 far[4] = {}; // requests, bytes, cache hits, their bytes
  if (!stream->GetArgument(0, 0, &points) || !stream->GetArgument(0, 1, &nodes) ||
    !stream->GetArgument(0, 2, &this->ProjectedSpacing) || !stream->GetArgument(0, 3, &complete) ||
    !stream->GetArgument(0, 4, &outdated) || !stream->GetArgument(0, 5, &this->HostMemoryBudget) ||
    !stream->GetArgument(0, 6, &this->Limits) || !stream->GetArgument(0, 7, &all) ||
    !stream->GetArgument(0, 8, &build) || !stream->GetArgument(0, 9, &technique) ||
    !stream->GetArgument(0, 10, &missing) || !stream->GetArgument(0, 11, &far[0]) ||
    !stream->GetArgument(0, 12, &far[1]) || !stream->GetArgument(0, 13, &far[2]) ||
    !stream->GetArgument(0, 14, &far[3]))
  {
    vtkErrorMacro("The server's frame cannot be read: client and server have different plugins. "
                  "Load the same build of the PointFront plugin on both.");
    return;
  }
  this->PointsDrawn = static_cast<vtkIdType>(points);
  this->NodesDrawn = static_cast<vtkIdType>(nodes);
  this->StorePoints = static_cast<vtkIdType>(all);
  this->Complete = complete != 0;
  this->Outdated = outdated != 0;
  this->Build = build;
  this->Technique = technique;
  this->MissingNodes = static_cast<vtkIdType>(missing);
  this->Traffic = { far[0], far[1], 0, far[2], far[3] };
}

//------------------------------------------------------------------------------
std::string vtkPVPointFrontFrame::GetPointsInView() const
{
  return pointfront::groupedDigits(static_cast<std::uint64_t>(this->PointsDrawn)) + " of " +
    pointfront::groupedDigits(static_cast<std::uint64_t>(this->StorePoints));
}

//------------------------------------------------------------------------------
std::string vtkPVPointFrontFrame::GetTraffic() const
{
  const std::string text = pointfront::trafficText(
    this->Traffic, static_cast<std::uint64_t>(std::max<vtkIdType>(this->MissingNodes, 0)));
  return text.empty() ? "none" : text;
}

//------------------------------------------------------------------------------
std::string vtkPVPointFrontFrame::GetExpectedDifference() const
{
  const auto expected = pointfront::expectedDifference(this->Technique, this->ProjectedSpacing);
  if (!expected)
  {
    return "not measured";
  }
  return pointfront::decimalText(expected->psnr.least, 1) + " to " +
    pointfront::decimalText(expected->psnr.most, 1) + " dB, " +
    pointfront::numberText(100.0 * expected->off.least, 2) + " to " +
    pointfront::numberText(100.0 * expected->off.most, 2) + " % of the pixels off (" +
    this->Technique + "; " + pointfront::curveSource() + ")";
}

//------------------------------------------------------------------------------
std::string vtkPVPointFrontFrame::GetLimitedBy() const
{
  using Representation = vtkPointFrontRepresentation;
  std::string words = this->Build.empty() ? "" : "the build (" + this->Build + ")";
  for (const auto& [limit, name] :
    { std::pair<int, const char*>{ Representation::LOADING, "still loading" },
      { Representation::FRAME_TIME, "the time of a frame in motion" },
      { Representation::POINT_BUDGET, "Point Budget" },
      { Representation::GPU_MEMORY, "GPU Memory Budget" },
      { Representation::HOST_MEMORY, "Host Memory Budget (Settings)" },
      { Representation::UNREADABLE, "parts of the store that cannot be read" } })
  {
    if ((this->Limits & limit) != 0)
    {
      words += (words.empty() ? "" : ", ") + std::string(name);
    }
  }
  return words.empty() ? "nothing" : words;
}

//------------------------------------------------------------------------------
void vtkPVPointFrontFrame::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "PointsDrawn: " << this->PointsDrawn << "\n"
     << indent << "NodesDrawn: " << this->NodesDrawn << "\n"
     << indent << "ProjectedSpacing: " << this->ProjectedSpacing << " px\n"
     << indent << "HostMemoryBudget: " << this->HostMemoryBudget << " MiB\n"
     << indent << "LimitedBy: " << this->GetLimitedBy() << "\n"
     << indent << "Traffic: " << this->GetTraffic() << "\n"
     << indent << "ExpectedDifference: " << this->GetExpectedDifference() << "\n"
     << indent << "Complete: " << this->Complete << "\n"
     << indent << "Outdated: " << this->Outdated << "\n";
}
