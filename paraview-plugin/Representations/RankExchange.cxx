#include "RankExchange.h"

#include "vtkCamera.h"
#include "vtkCommunicator.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <array>
#include <vector>

namespace pointfront
{
namespace
{

/// This share of the picture's middle holds, whatever is rounded: a third of a pixel of 640 is left
/// out.
constexpr double inner = 0.999;

/// At most as many values go into a message as its length can say.
constexpr std::size_t mostValues = std::size_t(1) << 24;

template <typename T, typename Reduce>
void inMessages(T* values, std::size_t count, const Reduce& reduce)
{
  std::vector<T> result(std::min(count, mostValues));
  for (std::size_t begin = 0; begin < count; begin += mostValues)
  {
    const std::size_t length = std::min(mostValues, count - begin);
    reduce(values + begin, result.data(), static_cast<vtkIdType>(length));
    std::copy_n(result.data(), length, values + begin);
  }
}

using Clip = std::array<double, 4>; ///< homogeneous
using Polygon = std::vector<Clip>;

/// How far the place is inside of one of the six planes of the view; negative outside.
double inside(const Clip& place, std::size_t plane)
{
  const std::size_t axis = plane / 2;
  const double reach = (axis < 2 ? inner : 1.0) * place[3];
  return plane % 2 == 0 ? reach - place[axis] : reach + place[axis];
}

/// The part of the polygon that lies inside of the plane (Sutherland and Hodgman 1974).
Polygon cut(const Polygon& polygon, std::size_t plane)
{
  Polygon part;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    const Clip& from = polygon[i];
    const Clip& to = polygon[(i + 1) % polygon.size()];
    const double near = inside(from, plane);
    const double far = inside(to, plane);
    if (near >= 0.0)
    {
      part.push_back(from);
    }
    if ((near >= 0.0) != (far >= 0.0))
    {
      const double share = near / (near - far);
      Clip between;
      for (std::size_t k = 0; k < between.size(); ++k)
      {
        between[k] = from[k] + share * (to[k] - from[k]);
      }
      part.push_back(between);
    }
  }
  return part;
}

/// The corners of a side of the box, one after the other around it.
Polygon sideOf(const double bounds[6], std::size_t side, vtkMatrix4x4* toClip)
{
  constexpr std::size_t around[4][2] = { { 0, 0 }, { 0, 1 }, { 1, 1 }, { 1, 0 } };
  const std::size_t axis = side / 2;
  Polygon polygon;
  for (const auto& corner : around)
  {
    Clip place{ 0.0, 0.0, 0.0, 1.0 };
    place[axis] = bounds[side];
    for (std::size_t k = 0; k < 2; ++k)
    {
      const std::size_t other = (axis + 1 + k) % 3;
      place[other] = bounds[2 * other + corner[k]];
    }
    polygon.emplace_back();
    toClip->MultiplyPoint(place.data(), polygon.back().data());
  }
  return polygon;
}

} // namespace

bool isSurelyInView(vtkRenderer* renderer, const double bounds[6])
{
  vtkCamera* const camera = renderer->GetActiveCamera();
  vtkMatrix4x4* const toClip =
    camera->GetCompositeProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0);
  for (std::size_t side = 0; side < 6; ++side)
  {
    Polygon seen = sideOf(bounds, side, toClip);
    for (std::size_t plane = 0; plane < 6 && !seen.empty(); ++plane)
    {
      seen = cut(seen, plane);
    }
    if (!seen.empty())
    {
      return true;
    }
  }
  // No side is seen: all of the view lies in the box, or nothing.
  vtkNew<vtkMatrix4x4> toWorld;
  vtkMatrix4x4::Invert(toClip, toWorld);
  const double middle[4] = { 0.0, 0.0, 0.0, 1.0 };
  double world[4];
  toWorld->MultiplyPoint(middle, world);
  const auto holds = [&](std::size_t axis)
  {
    const double place = world[axis] / world[3];
    return place > bounds[2 * axis] && place < bounds[2 * axis + 1];
  };
  return holds(0) && holds(1) && holds(2);
}

bool RankExchange::agreed(vtkMultiProcessController* ranks, bool wanted)
{
  ranks_ = ranks;
  if (!ranks || ranks->GetNumberOfProcesses() < 2)
  {
    return false;
  }
  const int mine = wanted ? 1 : 0;
  int all = 0;
  ranks->AllReduce(&mine, &all, 1, vtkCommunicator::MIN_OP);
  return all != 0;
}

bool RankExchange::nearest(float* depths, std::size_t count)
{
  // Both ends in one reduction.
  const double mine[2] = { static_cast<double>(count), -static_cast<double>(count) };
  double least[2];
  ranks_->AllReduce(mine, least, 2, vtkCommunicator::MIN_OP);
  if (least[0] != -least[1])
  {
    return false;
  }
  inMessages(depths, count,
    [&](const float* from, float* to, vtkIdType length)
    { ranks_->AllReduce(from, to, length, vtkCommunicator::MIN_OP); });
  return true;
}

void RankExchange::sum(std::uint32_t* sums, std::size_t count)
{
  inMessages(sums, count,
    [&](const std::uint32_t* from, std::uint32_t* to, vtkIdType length)
    { ranks_->AllReduce(from, to, length, vtkCommunicator::SUM_OP); });
}

} // namespace pointfront
