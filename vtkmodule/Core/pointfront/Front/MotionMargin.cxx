#include "pointfront/Front/MotionMargin.h"

#include "pointfront/Front/ScreenError.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace pointfront
{
namespace
{

/// A zoom is not believed further than that.
constexpr double mostZoom = 4.0;

glm::dvec3 turned(const glm::dvec3& before, const glm::dvec3& now, double frames)
{
  const glm::dvec3 ahead = now + frames * (now - before);
  const double length = glm::length(ahead);
  return length > 1e-6 ? ahead / length : now;
}

} // namespace

View viewAhead(const View& before, const View& now, double frames)
{
  if (before == now || before.parallel != now.parallel || before.width != now.width ||
    before.height != now.height)
  {
    return now;
  }
  View ahead = now;
  ahead.position = now.position + frames * (now.position - before.position);
  ahead.direction = turned(before.direction, now.direction, frames);
  ahead.pixelsPerUnit = now.pixelsPerUnit *
    std::clamp(
      std::pow(now.pixelsPerUnit / before.pixelsPerUnit, frames), 1.0 / mostZoom, mostZoom);
  for (std::size_t p = 0; p < now.planes.size(); ++p)
  {
    if (now.planes[p].w == std::numeric_limits<double>::max())
    {
      continue; // nothing is beyond it
    }
    // The eye keeps its distance to each plane: 0 to the sides of a perspective view.
    const double eye = glm::dot(glm::dvec3(now.planes[p]), now.position) + now.planes[p].w;
    const glm::dvec3 normal =
      turned(glm::dvec3(before.planes[p]), glm::dvec3(now.planes[p]), frames);
    ahead.planes[p] = glm::dvec4(normal, eye - glm::dot(normal, ahead.position));
  }
  return ahead;
}

const std::vector<LoadRequest>& MotionMargin::requests(const View& now, double thresholdPx,
  const ResidencySnapshot& residency, double frames, std::uint32_t most,
  const std::vector<LayerLimits>& layers)
{
  requests_.clear();
  visits_ = 0;
  const View ahead = first_ ? now : viewAhead(before_, now, frames);
  rest(now);
  if (ahead == now)
  {
    return requests_;
  }
  for (const NodeIndex root : hierarchy_->roots())
  {
    const std::uint16_t number = hierarchy_->node(root).layer;
    const LayerLimits layer = number < layers.size() ? layers[number] : LayerLimits();
    // Where a lens will be is not known.
    if (layer.visible && layer.windows.empty())
    {
      visit(root, ahead, layer, thresholdPx, residency);
    }
  }
  const auto sooner = [](const LoadRequest& a, const LoadRequest& b)
  { return a.priority != b.priority ? a.priority > b.priority : a.node < b.node; };
  std::sort(requests_.begin(), requests_.end(), sooner);
  requests_.resize(std::min<std::size_t>(requests_.size(), most));
  return requests_;
}

void MotionMargin::rest(const View& now)
{
  before_ = now;
  first_ = false;
}

void MotionMargin::visit(NodeIndex index, const View& ahead, const LayerLimits& layer,
  double thresholdPx, const ResidencySnapshot& residency)
{
  if (++visits_ > visitLimit)
  {
    return;
  }
  Node node;
  if (hierarchy_->peek(index, node) != RowState::Here)
  {
    return; // by the next frame it may be
  }
  if (sphereVisibility(ahead, node.centre, node.radius) == Visibility::Outside)
  {
    return;
  }
  const auto verdict = layer.pruning ? layer.pruning->of(index) : NodePruning::Verdict::Draw;
  if (verdict == NodePruning::Verdict::Skip)
  {
    return;
  }
  const double errorPx = screenError(ahead, node) / layer.errorFactor;
  if (verdict == NodePruning::Verdict::Draw && node.pointCount > 0 &&
    residency.state(index) == ResidencySnapshot::State::Absent)
  {
    requests_.push_back({ index, errorPx, true, node.pointCount, node.layer });
  }
  for (std::uint8_t c = 0; errorPx > thresholdPx && c < node.childCount; ++c)
  {
    visit(node.firstChild + c, ahead, layer, thresholdPx, residency);
  }
}

} // namespace pointfront
