#include "NormalsPass.h"

#include "ClassChoice.h"
#include "FlannIndex.h"
#include "PCLFit.h"
#include "SplatCodes.h"
#include "SurfaceFit.h"

#include "pointfront/Neighbourhood/NearestNeighbours.h"
#include "pointfront/Neighbourhood/SplatCell.h"
#include "pointfront/Points/NormalAttribute.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace pointfront
{
namespace
{
/// Points that the radius of a splat is from, the point itself included.
constexpr std::uint32_t ofRadius = NearOffsets::most + 1;
constexpr double curvatureSteps = 65535.0 * 3.0; // to 1; the largest curvature is 1/3

Attribute curvatureAttribute()
{
  return { "curvature", ScalarType::UInt16, 1, 1.0 / curvatureSteps, 0.0,
    "smallest eigenvalue of the neighbours' covariance over the sum of all" };
}

/// The values that are wanted of a neighbourhood, in this order.
struct SurfaceValues
{
  bool normal = true;
  bool curvature = false;
  bool radius = true;
  bool byPCL = false; ///< normal and curvature

  std::size_t curvatureAt() const { return normal ? sizeof(PackedNormal) : 0; }
  std::size_t radiusAt() const { return curvatureAt() + (curvature ? sizeof(std::uint16_t) : 0); }
  /// While the base of radii is not known.
  std::size_t waitingBytes() const { return radiusAt() + (radius ? sizeof(WaitingRadius) : 0); }
  std::size_t bytes() const { return radiusAt() + (radius ? 1 : 0); }
};

class SurfaceFeature final : public NeighbourhoodFeature
{
public:
  /// A plane of the nearest `ofPlane` of so many neighbours; 0: of all within a radius.
  SurfaceFeature(std::uint32_t ofPlane, std::uint32_t neighbours, SurfaceValues values,
    std::atomic<std::uint64_t>& without, SplatCodes& radii)
    : ofPlane_(ofPlane)
    , neighbours_(neighbours)
    , values_(values)
    , without_(without)
    , radii_(radii)
  {
  }
  std::size_t bytes() const override { return values_.waitingBytes(); }
  bool orderFree() const override
  {
    return ofPlane_ == neighbours_ && neighbours_ <= mostExactlySummed && !values_.byPCL;
  }
  void compute(
    const glm::dvec3& position, const std::vector<NearPoint>& near, std::byte* value) const override
  {
    const auto planeOf = values_.byPCL ? fitSurfaceByPCL : fitSurface;
    const std::optional<SurfaceFit> fit = ofPlane_ == neighbours_
      ? planeOf(position, near)
      : planeOf(position, nearestOf(near, ofPlane_));
    if (values_.normal)
    {
      if (!fit)
      {
        ++without_; // not touched for each point: all threads share it
      }
      const PackedNormal normal = facingUp(packNormal(fit ? fit->normal : glm::dvec3(0.0)));
      std::memcpy(value, &normal, sizeof normal);
    }
    if (values_.curvature)
    {
      const double steps = std::min(65535.0, (fit ? fit->curvature : 0.0) * curvatureSteps);
      const auto curvature = static_cast<std::uint16_t>(std::lround(steps));
      std::memcpy(value + values_.curvatureAt(), &curvature, sizeof curvature);
    }
    if (values_.radius)
    {
      const WaitingRadius radius = waitingRadius(ofPlane_ == neighbours_ && !values_.byPCL
          ? radiusOf(position, near, fit)
          : radiusOf(position, near, fitSurface(position, near)));
      radii_.count(radius);
      std::memcpy(value + values_.radiusAt(), &radius, sizeof radius);
    }
  }

  void copied(const std::byte* value) const override
  {
    if (values_.normal)
    {
      PackedNormal normal;
      std::memcpy(&normal, value, sizeof normal);
      if (normal == PackedNormal(0))
      {
        ++without_;
      }
    }
  }

private:
  /// So many points of a list that has the nearest first.
  static std::vector<NearPoint> nearestOf(const std::vector<NearPoint>& near, std::uint32_t wanted)
  {
    std::vector<NearPoint> nearest;
    for (const NearPoint& point : near)
    {
      if (wanted == 0)
      {
        break;
      }
      nearest.push_back(point);
      nearest.back().count = std::min(point.count, wanted);
      wanted -= nearest.back().count;
    }
    return nearest;
  }

  static double radiusOf(const glm::dvec3& position, const std::vector<NearPoint>& near,
    const std::optional<SurfaceFit>& fit)
  {
    constexpr std::size_t usual = ofRadius;
    NearOffsets offsets;
    std::array<glm::dvec3, usual> few;
    for (std::size_t i = 0; i < std::min(near.size(), usual); ++i)
    {
      few[i] = near[i].position - position;
    }
    offsets.assign(few.data(), std::min(near.size(), usual));
    for (std::size_t i = usual; i < near.size(); ++i)
    {
      offsets.add(near[i].position - position);
    }
    const NeighbourPlane plane =
      fit ? NeighbourPlane{ fit->normal, fit->curvature, fit->width } : NeighbourPlane();
    return splatRadius(offsets, plane);
  }

  std::uint32_t ofPlane_;
  std::uint32_t neighbours_;
  SurfaceValues values_;
  std::atomic<std::uint64_t>& without_;
  SplatCodes& radii_;
};

std::vector<SourceDescription> descriptionsOf(const PointSources& sources)
{
  std::vector<SourceDescription> descriptions;
  for (const auto& source : sources)
  {
    descriptions.push_back(source->description());
  }
  return descriptions;
}

/// The values of a column, normals turned towards the scanner where it is known.
ValueSource facingTheScanner(
  const ValueSource& values, std::vector<SourceDescription> descriptions, std::size_t bytes)
{
  return [values, descriptions = std::move(descriptions), bytes](
           const SourceChunk& chunk, const PointBatch& batch, std::byte* out) -> Result<void>
  {
    Result<void> done = values(chunk, batch, out);
    const glm::dvec3* const scanner = descriptions[chunk.source].scanner(chunk.chunk);
    for (std::size_t i = 0; done && scanner != nullptr && i < batch.size(); ++i)
    {
      PackedNormal normal;
      std::memcpy(&normal, out + i * bytes, sizeof normal);
      normal = facing(normal, batch.positions[i], *scanner);
      std::memcpy(out + i * bytes, &normal, sizeof normal);
    }
    return done;
  };
}

/// The values of a column whose radii still wait for their base.
ValueSource withRadiusCodes(const ValueSource& values, SurfaceValues kept, double base)
{
  return [values, kept, base](
           const SourceChunk& chunk, const PointBatch& batch, std::byte* out) -> Result<void>
  {
    std::vector<std::byte> waiting(batch.size() * kept.waitingBytes());
    Result<void> done = values(chunk, batch, waiting.data());
    for (std::size_t i = 0; done && i < batch.size(); ++i)
    {
      const std::byte* const from = waiting.data() + i * kept.waitingBytes();
      std::byte* const to = out + i * kept.bytes();
      std::copy(from, from + kept.radiusAt(), to);
      WaitingRadius radius = 0;
      std::memcpy(&radius, from + kept.radiusAt(), sizeof radius);
      to[kept.radiusAt()] = std::byte(splatCode(radius, base));
    }
    return done;
  };
}

std::vector<Attribute> attributesOf(const SurfaceValues& values)
{
  std::vector<Attribute> attributes;
  if (values.normal)
  {
    attributes.push_back(normalAttribute());
  }
  if (values.curvature)
  {
    attributes.push_back(curvatureAttribute());
  }
  if (values.radius)
  {
    attributes.push_back(splatRadiusColumn());
  }
  return attributes;
}
} // namespace

Result<PointSources> NormalsPass::apply(PointSources sources, const PassResources& resources) const
{
  if (options_.byPCL && !hasPCLFit())
  {
    return makeError(Error::Kind::Unsupported,
      "normals by PCL: this build was made without it (POINTFRONT_PCL); normals by pca need no "
      "PCL");
  }
  const InputOrder order(sources);
  NeighbourhoodOptions search;
  const SurfaceValues kept{ options_.normals, options_.curvature, options_.splatRadius,
    options_.byPCL };
  const std::uint32_t ofPlane = options_.radius > 0.0 ? 0 : options_.neighbours;
  search.neighbours = kept.radius && ofPlane > 0 ? std::max(ofPlane, ofRadius) : ofPlane;
  search.radius = options_.radius;
  search.tilePoints = options_.tilePoints;
  search.phase = options_.normals ? "normals" : "splat sizes";
  const Result<ClassSet> classes = chosenClasses(sources, options_.classes);
  if (!classes)
  {
    return classes.error();
  }
  search.participants = { *classes, *classes };
  const auto eps = static_cast<float>(options_.eps);
  without_ = 0;
  const auto radii = std::make_unique<SplatCodes>();
  const SurfaceFeature feature(ofPlane, search.neighbours, kept, without_, *radii);
  Result<std::unique_ptr<PointColumn>> column = computeFromNeighbours(
    sources, order, search,
    [eps](const PositionSet& set) { return std::make_unique<FlannIndex>(set, eps); }, feature,
    resources);
  if (!column)
  {
    return column.error();
  }
  ValueSource values = valuesOf(std::move(*column), order);
  const double base = radii->base();
  if (kept.radius)
  {
    values = withRadiusCodes(values, kept, base);
  }
  if (kept.normal)
  {
    values = facingTheScanner(values, descriptionsOf(sources), kept.bytes());
  }
  return withAttributes(std::move(sources), attributesOf(kept), values,
    [&](SourceDescription& description)
    { description.splatRadiusBase = kept.radius ? base : description.splatRadiusBase; });
}

std::vector<std::string> NormalsPass::findings() const
{
  if (without_ == 0)
  {
    return {};
  }
  if (without_ == 1)
  {
    return { "1 point has no normal: it has fewer than three neighbours, or all are on one line." };
  }
  return { std::to_string(without_) +
    " points have no normal: they have fewer than three neighbours, or all are on one line." };
}

} // namespace pointfront
