#include "pointfront/Front/ViewMargin.h"

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

/// How fast the distance to the plane grows across the line of sight.
double acrossSight(const View& view, const glm::dvec4& plane)
{
  const glm::dvec3 normal(plane);
  return glm::length(normal - glm::dot(normal, view.direction) * view.direction);
}

/// `otherwise` where the normal has no length: frusta that close at once.
glm::dvec4 unitPlane(const glm::dvec4& plane, const glm::dvec4& otherwise)
{
  const double length = glm::length(glm::dvec3(plane));
  return length > 1e-12 ? plane / length : otherwise;
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

View widened(const View& now, double share)
{
  View wide = now;
  for (const std::size_t left : { 0, 2 })
  {
    const glm::dvec4 a = now.planes[left];
    const glm::dvec4 b = now.planes[left + 1];
    // Weights that make their sum the depth, in which both sides of a viewport are equally far.
    const double ofA = acrossSight(now, b);
    const double ofB = acrossSight(now, a);
    const glm::dvec4 depth = ofA * a + ofB * b;
    wide.planes[left] = unitPlane(ofA * a + share * depth, a);
    wide.planes[left + 1] = unitPlane(ofB * b + share * depth, b);
  }
  return wide;
}

const std::vector<LoadRequest>& ViewMargin::ahead(const View& now, double thresholdPx,
  const ResidencySnapshot& residency, double frames, std::uint32_t most,
  const std::vector<LayerLimits>& layers)
{
  const View ahead = first_ ? now : viewAhead(before_, now, frames);
  rest(now);
  if (ahead != now)
  {
    walk(ahead, thresholdPx, residency, most, layers);
  }
  return requests_;
}

const std::vector<LoadRequest>& ViewMargin::around(const View& now, double thresholdPx,
  const ResidencySnapshot& residency, double share, std::uint32_t most,
  const std::vector<LayerLimits>& layers)
{
  rest(now);
  walk(widened(now, share), thresholdPx, residency, most, layers);
  return requests_;
}

void ViewMargin::rest(const View& now)
{
  requests_.clear();
  rowsComing_ = false;
  before_ = now;
  first_ = false;
}

void ViewMargin::walk(const View& shown, double thresholdPx, const ResidencySnapshot& residency,
  std::uint32_t most, const std::vector<LayerLimits>& layers)
{
  visits_ = 0;
  for (const NodeIndex root : hierarchy_->roots())
  {
    const std::uint16_t number = hierarchy_->node(root).layer;
    const LayerLimits layer = number < layers.size() ? layers[number] : LayerLimits();
    // Where a lens will be is not known.
    if (layer.visible && layer.windows.empty())
    {
      visit(root, shown, layer, thresholdPx, residency);
    }
  }
  const auto sooner = [](const LoadRequest& a, const LoadRequest& b)
  { return a.priority != b.priority ? a.priority > b.priority : a.node < b.node; };
  std::sort(requests_.begin(), requests_.end(), sooner);
  requests_.resize(std::min<std::size_t>(requests_.size(), most));
}

void ViewMargin::visit(NodeIndex index, const View& shown, const LayerLimits& layer,
  double thresholdPx, const ResidencySnapshot& residency)
{
  if (++visits_ > visitLimit)
  {
    return;
  }
  Node node;
  const RowState row = hierarchy_->peek(index, node);
  if (row != RowState::Here)
  {
    rowsComing_ = rowsComing_ || row == RowState::Coming;
    return; // by the next frame it may be
  }
  if (sphereVisibility(shown, node.centre, node.radius) == Visibility::Outside)
  {
    return;
  }
  const auto verdict = layer.pruning ? layer.pruning->of(index) : NodePruning::Verdict::Draw;
  if (verdict == NodePruning::Verdict::Skip)
  {
    return;
  }
  const double errorPx = screenError(shown, node) / layer.errorFactor;
  if (verdict == NodePruning::Verdict::Draw && node.pointCount > 0 &&
    residency.state(index) == ResidencySnapshot::State::Absent)
  {
    requests_.push_back({ index, errorPx, true, node.pointCount, node.layer });
  }
  for (std::uint8_t c = 0; errorPx > thresholdPx && c < node.childCount; ++c)
  {
    visit(node.firstChild + c, shown, layer, thresholdPx, residency);
  }
}

} // namespace pointfront
