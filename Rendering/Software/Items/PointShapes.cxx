#include "PointShapes.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace pointfront
{
namespace
{

/// A point's own radius counts up to that many times what closes its node: a stray point far from
/// all others is no surface.
constexpr float mostOfClosing = 4.0f;
/// Weight of a blended splat's centre: six bits.
constexpr float weightOfCentre = 63.0f;

/// Points one after the other: columns are read where they lie.
struct Consecutive
{
  std::uint32_t first;
  std::uint32_t operator()(int j) const { return first + static_cast<std::uint32_t>(j); }
  template <typename T, std::size_t Components>
  const T* values(const T* column, int, T*) const
  {
    return column + Components * std::size_t(first);
  }
};

/// Points from anywhere: their values are copied together.
struct Listed
{
  const std::uint32_t* points;
  std::uint32_t operator()(int j) const { return points[j]; }
  template <typename T, std::size_t Components>
  const T* values(const T* column, int count, T* scratch) const
  {
    for (int j = 0; j < count; ++j)
    {
      std::copy_n(column + Components * std::size_t(points[j]), Components,
        scratch + Components * std::size_t(j));
    }
    return scratch;
  }
};

/// Lengths of the store, times `factor`; 0 for one that is none.
template <typename Points>
void loadLengths(const std::byte* column, const Attribute& attribute, const Points& points,
  int count, float factor, float* lengths)
{
  visitScalar(attribute.type,
    [&](auto zero)
    {
      for (int j = 0; j < count; ++j)
      {
        decltype(zero) stored;
        std::memcpy(&stored, column + points(j) * attribute.bytes(), sizeof(stored));
        const double length = static_cast<double>(stored) * attribute.scale + attribute.offset;
        lengths[j] = length > 0.0 ? static_cast<float>(length) * factor : 0.0f;
      }
    });
}

/// Normals that are no 16-bit numbers.
template <typename Points>
void loadFloatNormals(const std::byte* column, const Points& points, int count,
  const glm::mat3& toCamera, RasterBatch& batch)
{
  for (int j = 0; j < count; ++j)
  {
    float n[3];
    std::memcpy(n, column + std::size_t(points(j)) * sizeof(n), sizeof(n));
    batch.normalX[j] = toCamera[0][0] * n[0] + toCamera[1][0] * n[1] + toCamera[2][0] * n[2];
    batch.normalY[j] = toCamera[0][1] * n[0] + toCamera[1][1] * n[1] + toCamera[2][1] * n[2];
    batch.normalZ[j] = toCamera[0][2] * n[0] + toCamera[1][2] * n[1] + toCamera[2][2] * n[2];
  }
}

} // namespace

template <typename Points>
void PointShapes::fillNormals(
  const RasterItem& item, const Points& points, int count, RasterBatch& batch) const
{
  const glm::mat3& toCamera = items_.normalToCamera();
  if (item.normals && item.normalAttribute->type == ScalarType::Int16)
  {
    std::int16_t scratch[3 * RasterBatch::size];
    StoredNormals stored;
    stored.xyz = points.template values<std::int16_t, 3>(
      reinterpret_cast<const std::int16_t*>(item.normals), count, scratch);
    for (int row = 0; row < 3; ++row)
    {
      for (int column = 0; column < 3; ++column)
      {
        stored.matrix[row][column] = toCamera[column][row];
      }
    }
    kernels_.loadNormals(stored, count, batch);
    return;
  }
  if (item.normals)
  {
    loadFloatNormals(item.normals, points, count, toCamera, batch);
    return;
  }
  const bool fixedNormals = item.style->orientation == SplatOrientation::Fixed;
  const SplatShape shape = item.passes.first.shape;
  if (!fixedNormals && (shape == SplatShape::Disc || shape == SplatShape::Sphere))
  {
    return; // nobody asks for them
  }
  const glm::vec3 fixed = fixedNormals ? toCamera * item.style->fixedNormal : glm::vec3(0.0f);
  std::fill(batch.normalX, batch.normalX + count, fixed.x);
  std::fill(batch.normalY, batch.normalY + count, fixed.y);
  std::fill(batch.normalZ, batch.normalZ + count, fixed.z);
}

template <typename Points>
void PointShapes::fillBy(
  const RasterItem& item, const Points& points, int count, float share, RasterBatch& batch) const
{
  if (item.style->size.mode == SplatSize::Mode::Pixels)
  {
    const float pixels =
      static_cast<float>(0.5 * item.style->size.value) * share / item.camera.scaleY;
    for (int j = 0; j < count; ++j)
    {
      batch.radius[j] = pixels * (item.camera.parallel ? 1.0f : batch.depth[j]);
    }
  }
  else if (item.sizes)
  {
    const auto factor = static_cast<float>(item.style->size.value) * items_.radiusFactor() * share;
    loadLengths(item.sizes, *item.sizeAttribute, points, count, factor, batch.radius);
  }
  else if (item.radiusCodes)
  {
    std::uint8_t scratch[RasterBatch::size];
    RadiusCodes stored;
    stored.codes = points.template values<std::uint8_t, 1>(item.radiusCodes, count, scratch);
    stored.radii = items_.radii().data();
    stored.scale = item.radiusScale * share;
    stored.unknown = item.radius * share;
    stored.most = mostOfClosing * item.sparsestRadius * share;
    stored.least = item.radiusBounded() ? item.radius * share : 0.0f;
    kernels_.loadRadii(stored, count, batch);
  }
  else
  {
    std::fill(batch.radius, batch.radius + count, item.radius * share);
  }
  item.passes.walls() ? fillHeights(item, points, count, batch)
                      : fillNormals(item, points, count, batch);
}

template <typename Points>
void PointShapes::fillHeights(
  const RasterItem& item, const Points& points, int count, RasterBatch& batch) const
{
  loadLengths(item.heights, *item.heightAttribute, points, count, items_.upFactor(), batch.height);
}

template <typename Points>
void PointShapes::grow(const RasterItem& item, const Points& points, int count, RasterBatch& batch)
{
  const PointGrowth& growth = item.item->growth;
  if (growth.whole())
  {
    std::fill(batch.grown, batch.grown + count, 1.0f);
    return;
  }
  for (int j = 0; j < count; ++j)
  {
    batch.grown[j] = growth.of(points(j));
  }
}

float PointShapes::largestRadius(const RasterItem& item)
{
  if (item.sizes)
  {
    return std::numeric_limits<float>::infinity();
  }
  return item.radiusCodes ? mostOfClosing * item.sparsestRadius : item.radius;
}

double PointShapes::largestHeight(const RasterItem& item)
{
  const Attribute& attribute = *item.heightAttribute;
  return visitScalar(attribute.type,
    [&](auto zero)
    {
      double most = 0.0;
      for (std::uint32_t point = item.item->first; point < item.item->last; ++point)
      {
        decltype(zero) stored;
        std::memcpy(&stored, item.heights + point * attribute.bytes(), sizeof(stored));
        const double height = static_cast<double>(stored) * attribute.scale + attribute.offset;
        most = height > most ? height : most;
      }
      return most;
    });
}

void PointShapes::fill(
  const RasterItem& item, std::uint32_t first, int count, float share, RasterBatch& batch) const
{
  fillBy(item, Consecutive{ first }, count, share, batch);
  grow(item, Consecutive{ first }, count, batch);
}

void PointShapes::fillBlended(
  const RasterItem& item, std::uint32_t first, int count, float share, RasterBatch& batch) const
{
  fillBy(item, Consecutive{ first }, count, share, batch);
  std::fill(batch.grown, batch.grown + count, 1.0f);
  for (int j = 0; j < count; ++j)
  {
    batch.weight[j] = weightOfCentre * item.item->growth.of(first + static_cast<std::uint32_t>(j));
  }
}

void PointShapes::fill(const RasterItem& item, const std::uint32_t* points, int count, float share,
  RasterBatch& batch) const
{
  fillBy(item, Listed{ points }, count, share, batch);
  grow(item, Listed{ points }, count, batch);
}

} // namespace pointfront
