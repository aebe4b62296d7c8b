#include "RasterItems.h"

#include "pointfront/Plan/SlotOrigin.h"
#include "pointfront/Points/SplatRadius.h"

#include <glm/geometric.hpp>
#include <glm/gtc/matrix_inverse.hpp>
#include <glm/matrix.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

namespace pointfront
{
namespace
{

const std::byte* columnOf(const NodeColumns& node, std::optional<std::uint32_t> column)
{
  if (!column)
  {
    return nullptr;
  }
  const auto place = std::find(node.selection.begin(), node.selection.end(), *column);
  return place == node.selection.end()
    ? nullptr
    : node.columns[static_cast<std::size_t>(place - node.selection.begin())].data();
}

/// Rows x, y and the line of sight: view space looks along -z.
glm::dmat3 cameraAxes(const FrameCamera& camera)
{
  glm::dmat3 axes(camera.storeToView);
  for (int column = 0; column < 3; ++column)
  {
    axes[column][2] = -axes[column][2];
  }
  return axes;
}

/// The matrix that takes normals to the camera. Their length only tells normals from none, if it is
/// near enough to 1. An actor's scale is taken off by a power of two, which changes no bit.
glm::mat3 normalAxes(const glm::dmat3& axes)
{
  const glm::dmat3 normals = glm::inverseTranspose(axes);
  double longest = 0.0;
  for (int column = 0; column < 3; ++column)
  {
    longest = std::max(longest, glm::length(normals[column]));
  }
  const bool scaled = longest > 0.0 && std::isfinite(longest);
  return glm::mat3(normals * (scaled ? std::exp2(-std::round(std::log2(longest))) : 1.0));
}

/// The camera of the projection, which all items share.
RasterCamera projectionOf(const FrameCamera& camera)
{
  const glm::dmat4& clip = camera.viewToClip;
  RasterCamera result;
  result.parallel = camera.parallel;
  const double halfWidth = 0.5 * camera.width, halfHeight = 0.5 * camera.height;
  // Perspective: clip w is k times the depth. What of x and y falls on w's axis moves the centre.
  const double k = camera.parallel ? clip[3][3] : -clip[2][3];
  result.scaleX = static_cast<float>(halfWidth * clip[0][0] / k);
  result.scaleY = static_cast<float>(halfHeight * clip[1][1] / k);
  const double offX = camera.parallel ? clip[3][0] : -clip[2][0];
  const double offY = camera.parallel ? clip[3][1] : -clip[2][1];
  result.centreX = static_cast<float>(halfWidth * (1.0 + offX / k));
  result.centreY = static_cast<float>(halfHeight * (1.0 + offY / k));
  return result;
}

/// Depths where clip z is -w and w.
std::array<double, 2> depthRange(const FrameCamera& camera)
{
  const glm::dmat4& clip = camera.viewToClip;
  // z = a v + b, w = c v + d with v = -depth
  const double a = clip[2][2], b = clip[3][2], c = clip[2][3], d = clip[3][3];
  const double nearDepth = (b + d) / (a + c);
  const double farDepth = (b - d) / (a - c);
  const bool bounded = std::isfinite(farDepth) && farDepth > nearDepth;
  return { nearDepth, bounded ? farDepth : std::numeric_limits<double>::max() };
}

} // namespace

/// As PointShapes reads them.
SizeTerms RasterItem::sizeTerms() const
{
  SizeTerms terms;
  terms.growth = item->growth;
  if (passes.squares || style->size.mode == SplatSize::Mode::Pixels || sizes)
  {
    return terms;
  }
  terms.radius = radius;
  if (radiusCodes)
  {
    terms.radiusScale = radiusScale;
    terms.sparsestRadius = sparsestRadius;
    terms.bounded = radiusBounded();
  }
  return terms;
}

RasterItems::RasterItems(const FramePlan& plan, std::size_t from, bool opaque)
  : plan_(plan)
  , first_(from == 0)
  , opaque_(opaque)
{
  for (const DrawBatch& batch : plan.batches)
  {
    for (const PlanItem& item : batch.items)
    {
      ordered_.push_back({ &item, &batch });
    }
  }
  std::stable_sort(ordered_.begin(), ordered_.end(),
    [](const PlannedItem& a, const PlannedItem& b)
    { return a.item->node->node < b.item->node->node; });
  const double volume = std::abs(glm::determinant(glm::dmat3(plan.camera.storeToView)));
  radiusFactor_ = static_cast<float>(std::cbrt(volume));
  for (std::size_t code = 0; code < radii_.size(); ++code)
  {
    radii_[code] =
      decodeSplatRadius(static_cast<std::uint8_t>(code), plan.splatRadiusBase) * radiusFactor_;
  }
  upFactor_ = static_cast<float>(glm::length(glm::dvec3(plan.camera.storeToView[2])));
  normalToCamera_ = normalAxes(cameraAxes(plan.camera));
  std::uint64_t base = 0;
  constexpr std::uint64_t most = std::numeric_limits<std::uint32_t>::max();
  for (end_ = from; end_ < ordered_.size(); ++end_)
  {
    const PlannedItem& planned = ordered_[end_];
    const bool twice = columnOf(*planned.item->node, planned.batch->style->heightColumn) != nullptr;
    const std::uint64_t points = (twice ? 2 : 1) * planned.item->node->size();
    if (base + points > most && end_ > from)
    {
      break;
    }
    append(itemOf(planned));
    if (twice)
    {
      append(wallsOf(items_.back()));
    }
    base += points;
  }
}

void RasterItems::append(RasterItem item)
{
  item.base = numbers_.end();
  numbers_.append(static_cast<std::uint32_t>(item.node().size()));
  item.passes.blended = item.passes.blended && !opaque_;
  blended_ = blended_ || item.passes.blended;
  items_.push_back(std::move(item));
}

RasterItem RasterItems::itemOf(const PlannedItem& planned)
{
  const NodeColumns& node = *planned.item->node;
  const ResolvedStyle& style = *planned.batch->style;
  auto table = std::find_if(
    tables_.begin(), tables_.end(), [&](const auto& known) { return known.first == &style; });
  if (table == tables_.end())
  {
    tables_.emplace_back(&style, std::make_unique<StyleColours>(style, *plan_.schema));
    table = tables_.end() - 1;
  }
  RasterItem item;
  item.item = planned.item;
  item.style = &style;
  item.colours = std::make_shared<PointColours>(plan_, style, *table->second, node);
  const bool own = style.orientation == SplatOrientation::Normal;
  item.normals = own ? columnOf(node, style.normalColumn) : nullptr;
  item.normalAttribute = item.normals ? &(*plan_.schema)[*style.normalColumn] : nullptr;
  item.passes = passesOf(style, conditionsOf(item));
  const std::byte* const codes = columnOf(node, style.radiusColumn);
  item.radiusCodes = reinterpret_cast<const std::uint8_t*>(codes);
  const auto value = static_cast<float>(style.size.value) * radiusFactor_;
  const bool spacing = style.size.mode == SplatSize::Mode::Spacing;
  item.radiusScale = planned.item->radiusScale * static_cast<float>(style.size.value);
  item.radius = spacing ? planned.item->closingRadius * value : 0.5f * value;
  item.sparsestRadius =
    std::max(item.radius, spacing ? planned.item->sparsestRadius * value : 0.0f);
  if (style.size.mode == SplatSize::Mode::Attribute)
  {
    item.sizes = columnOf(node, style.size.column);
    item.sizeAttribute = item.sizes ? &(*plan_.schema)[style.size.column] : nullptr;
    item.radius = planned.item->closingRadius * value;
  }
  setPlace(item);
  item.positions.filtered = !style.filter.empty();
  return item;
}

namespace
{
Thinning thinningOf(const PlanItem& item)
{
  if (!item.unfinished)
  {
    return Thinning::None;
  }
  if (item.refined)
  {
    return Thinning::Even;
  }
  const bool inPart = std::max(item.last, item.sizedFor) < item.node->size();
  return !inPart ? Thinning::None : item.node->parent == noNode ? Thinning::Random : Thinning::Even;
}
} // namespace

PassConditions RasterItems::conditionsOf(const RasterItem& item) const
{
  const bool oriented = item.normals || item.style->orientation == SplatOrientation::Fixed;
  const float spacingPx = std::max(plan_.spacingPx, item.item->growingSpacingPx);
  return { oriented, spacingPx, thinningOf(*item.item), plan_.camera.wholeHeight() };
}

RasterItem RasterItems::wallsOf(const RasterItem& item) const
{
  RasterItem walls = item;
  walls.passes = wallPassesOf(*item.style, conditionsOf(item));
  walls.normals = nullptr;
  walls.heights = columnOf(item.node(), item.style->heightColumn);
  walls.heightAttribute = &(*plan_.schema)[*item.style->heightColumn];
  return walls;
}

/// Where the node's points land: all that is large is taken off in double.
void RasterItems::setPlace(RasterItem& item) const
{
  const NodeColumns& node = item.node();
  const FrameCamera& camera = plan_.camera;
  const SlotOrigin origin =
    SlotOrigin::of(plan_.grid, node.halfSize, node.origin, camera.reference);
  const glm::dmat3 axes = cameraAxes(camera);
  const glm::dvec3 reference(
    camera.referenceInView.x, camera.referenceInView.y, -camera.referenceInView.z);
  const glm::dvec3 start = axes * glm::dvec3(origin.base) + reference;
  const std::array<double, 2> range = depthRange(camera);
  item.camera = projectionOf(camera);
  const glm::vec3 up(glm::normalize(axes[2]));
  std::copy_n(&up.x, 3, item.camera.up);
  // Depths in a parallel view count from its near plane: keys have no negative ones.
  const double shift = camera.parallel ? range[0] : 0.0;
  for (int row = 0; row < 3; ++row)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      item.camera.matrix[row][axis] =
        static_cast<float>(axes[axis][row] * std::ldexp(plan_.grid.scale[axis], origin.shift));
    }
    item.camera.matrix[row][3] = static_cast<float>(row == 2 ? start[row] - shift : start[row]);
  }
  item.camera.nearDepth = static_cast<float>(std::max(range[0] - shift, 0.0));
  item.camera.farDepth =
    static_cast<float>(std::min(range[1] - shift, double(std::numeric_limits<float>::max())));
  item.positions.xyz = reinterpret_cast<const std::uint32_t*>(node.positions.data());
  item.positions.shift = static_cast<std::uint32_t>(origin.shift);
  for (int axis = 0; axis < 3; ++axis)
  {
    item.positions.steps[axis] = origin.steps[axis];
  }
  setClipping(axes, reference, shift, item.positions);
}

void RasterItems::setClipping(const glm::dmat3& axes, const glm::dvec3& reference, double shift,
  RasterPositions& positions) const
{
  // Planes are taken at the reference point first: both terms are large, their sum is not.
  const glm::dmat3 normalMatrix = glm::inverseTranspose(axes);
  positions.clippingPlanes =
    static_cast<int>(std::min<std::size_t>(plan_.clippingPlanes.size(), 6));
  for (int plane = 0; plane < positions.clippingPlanes; ++plane)
  {
    const glm::dvec4& given = plan_.clippingPlanes[static_cast<std::size_t>(plane)];
    const glm::dvec3 normal = normalMatrix * glm::dvec3(given);
    const double atReference = given.w + given.x * plan_.camera.reference.x +
      given.y * plan_.camera.reference.y + given.z * plan_.camera.reference.z;
    const double distance = atReference - glm::dot(normal, reference) + normal.z * shift;
    const double values[4] = { normal.x, normal.y, normal.z, distance };
    for (int i = 0; i < 4; ++i)
    {
      positions.clipping[plane][i] = static_cast<float>(values[i]);
    }
  }
}

bool RasterItems::filter(
  const FramePlan& plan, const RasterItem& item, std::uint32_t first, int count, RasterBatch& batch)
{
  if (!item.positions.filtered)
  {
    return false;
  }
  const NodeColumns& node = item.node();
  const ColumnSelection columns = item.style->filter.columns();
  if (!std::includes(node.selection.begin(), node.selection.end(), columns.begin(), columns.end()))
  {
    std::fill(batch.keep, batch.keep + count, std::uint8_t(0)); // being read: not shown unasked
    return true;
  }
  item.style->filter.evaluate(
    node, *plan.schema, first, static_cast<std::uint32_t>(count), batch.keep);
  return true;
}

} // namespace pointfront
