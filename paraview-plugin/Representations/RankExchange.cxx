#include "RankExchange.h"

#include "vtkCamera.h"
#include "vtkCommunicator.h"
#include "vtkMatrix4x4.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkRenderer.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace pointfront
{
namespace
{

/// In parts of a picture that this share of its middle holds, whatever is rounded.
constexpr double inner = 0.96;
constexpr int steps = 8;

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

using Place = std::array<double, 3>;

Place unprojected(vtkMatrix4x4* toWorld, double x, double y, double depth)
{
  const double clip[4] = { x, y, depth, 1.0 };
  double world[4];
  toWorld->MultiplyPoint(clip, world);
  return { world[0] / world[3], world[1] / world[3], world[2] / world[3] };
}

/// Whether the way from one place to another meets the box.
bool meets(const Place& from, const Place& to, const double bounds[6])
{
  double first = 0.0;
  double last = 1.0;
  for (std::size_t axis = 0; axis < 3; ++axis)
  {
    const double way = to[axis] - from[axis];
    if (way == 0.0)
    {
      last = from[axis] < bounds[2 * axis] || from[axis] > bounds[2 * axis + 1] ? -1.0 : last;
      continue;
    }
    const double one = (bounds[2 * axis] - from[axis]) / way;
    const double other = (bounds[2 * axis + 1] - from[axis]) / way;
    first = std::max(first, std::min(one, other));
    last = std::min(last, std::max(one, other));
  }
  return first < last;
}

} // namespace

bool isSurelyInView(vtkRenderer* renderer, const double bounds[6])
{
  vtkCamera* const camera = renderer->GetActiveCamera();
  vtkMatrix4x4* const toClip =
    camera->GetCompositeProjectionTransformMatrix(renderer->GetTiledAspectRatio(), -1.0, 1.0);
  vtkNew<vtkMatrix4x4> toWorld;
  vtkMatrix4x4::Invert(toClip, toWorld);
  for (int i = 0; i <= steps; ++i)
  {
    for (int j = 0; j <= steps; ++j)
    {
      const double x = inner * (2.0 * i / steps - 1.0);
      const double y = inner * (2.0 * j / steps - 1.0);
      if (meets(unprojected(toWorld, x, y, -inner), unprojected(toWorld, x, y, inner), bounds))
      {
        return true;
      }
    }
  }
  const double middle[4] = { 0.5 * (bounds[0] + bounds[1]), 0.5 * (bounds[2] + bounds[3]),
    0.5 * (bounds[4] + bounds[5]), 1.0 };
  double clip[4];
  toClip->MultiplyPoint(middle, clip);
  return clip[3] > 0.0 &&
    std::all_of(clip, clip + 3, [&](double c) { return std::abs(c) < inner * clip[3]; });
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
