#include "PointPick.h"

#include "MappedStores.h"

#include <vtkDataObject.h>
#include <vtkHardwareSelector.h>
#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>

#include <glm/common.hpp>

#include <array>

namespace pointfront
{

namespace
{
}

Result<std::optional<PickedPoint>> pointAt(
  const glm::ivec2& pixel, vtkRenderer* renderer, const MappedStores& stores)
{
  const int* const size = renderer->GetRenderWindow()->GetSize();
  const glm::ivec2 last = glm::max(glm::ivec2(size[0], size[1]) - 1, glm::ivec2(0));
  const glm::uvec2 low(glm::clamp(pixel - reachPx, glm::ivec2(0), last));
  const glm::uvec2 high(glm::clamp(pixel + reachPx, glm::ivec2(0), last));
  vtkNew<vtkHardwareSelector> selector;
  selector->SetRenderer(renderer);
  selector->SetArea(low.x, low.y, high.x, high.y);
  selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_POINTS);
  if (!selector->CaptureBuffers())
  {
    return makeError(Error::Kind::Unsupported, "this OpenGL does not tell which point is drawn");
  }
  const glm::uvec2 at(glm::clamp(pixel, glm::ivec2(low), glm::ivec2(high)));
  const std::array<unsigned, 2> middle{ at.x, at.y };
  std::array<unsigned, 2> where{};
  const auto found = selector->GetPixelInformation(middle.data(), reachPx, where.data());
  const auto cloud = found.Valid ? stores.cloudOf(found.Prop) : nullptr;
  if (!cloud)
  {
    return std::optional<PickedPoint>();
  }
  Result<PickedPoint> point = readPoint(*cloud, static_cast<std::uint64_t>(found.AttributeID));
  return point ? Result<std::optional<PickedPoint>>(std::optional<PickedPoint>(std::move(*point)))
               : point.error();
}

} // namespace pointfront
