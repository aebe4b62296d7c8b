#include "NormalsPass.h"

#include "ClassChoice.h"
#include "FlannIndex.h"
#include "SurfaceFit.h"

#include "pointfront/Neighbourhood/NearestNeighbours.h"
#include "pointfront/Points/NormalAttribute.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pointfront
{
namespace
{
constexpr double curvatureSteps = 65535.0 * 3.0; // to 1; the largest curvature is 1/3

Attribute curvatureAttribute()
{
  return { "curvature", ScalarType::UInt16, 1, 1.0 / curvatureSteps, 0.0,
    "smallest eigenvalue of the neighbours' covariance over the sum of all" };
}

/// Normal, then curvature if asked.
class SurfaceFeature final : public NeighbourhoodFeature
{
public:
  /// Of so many neighbours; 0: those within a radius.
  SurfaceFeature(
    std::uint32_t neighbours, bool curvature, std::atomic<std::uint64_t>& without)
    : neighbours_(neighbours)
    , curvature_(curvature)
    , without_(without)
  {
  }
  std::size_t bytes() const override
  {
    return sizeof(PackedNormal) + (curvature_ ? sizeof(std::uint16_t) : 0);
  }
  bool orderFree() const override { return neighbours_ <= mostExactlySummed; }
  void compute(const glm::dvec3& position, const std::vector<NearPoint>& near,
    std::byte* value) const override
  {
    const std::optional<SurfaceFit> fit = fitSurface(position, near);
    if (!fit)
    {
      ++without_; // not touched for each point: all threads share it
    }
    const PackedNormal normal = facingUp(packNormal(fit ? fit->normal : glm::dvec3(0.0)));
    std::memcpy(value, &normal, sizeof normal);
    if (curvature_)
    {
      const double steps = std::min(65535.0, (fit ? fit->curvature : 0.0) * curvatureSteps);
      const auto curvature = static_cast<std::uint16_t>(std::lround(steps));
      std::memcpy(value + sizeof normal, &curvature, sizeof curvature);
    }
  }

private:
  std::uint32_t neighbours_;
  bool curvature_;
  std::atomic<std::uint64_t>& without_;
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
} // namespace

Result<PointSources> NormalsPass::apply(
  PointSources sources, const PassResources& resources) const
{
  const InputOrder order(sources);
  NeighbourhoodOptions search;
  search.neighbours = options_.radius > 0.0 ? 0 : options_.neighbours;
  search.radius = options_.radius;
  search.tilePoints = options_.tilePoints;
  search.phase = "normals";
  const Result<ClassSet> classes = chosenClasses(sources, options_.classes);
  if (!classes)
  {
    return classes.error();
  }
  search.participants = { *classes, *classes };
  const auto eps = static_cast<float>(options_.eps);
  without_ = 0;
  const SurfaceFeature feature(search.neighbours, options_.curvature, without_);
  Result<std::unique_ptr<PointColumn>> column = computeFromNeighbours(
    sources, order, search,
    [eps](const PositionSet& set) { return std::make_unique<FlannIndex>(set, eps); }, feature,
    resources);
  if (!column)
  {
    return column.error();
  }
  std::vector<Attribute> attributes{ normalAttribute() };
  if (options_.curvature)
  {
    attributes.push_back(curvatureAttribute());
  }
  const ValueSource values = facingTheScanner(
    valuesOf(std::move(*column), order), descriptionsOf(sources), feature.bytes());
  return withAttributes(std::move(sources), attributes, values);
}

std::vector<std::string> NormalsPass::findings() const
{
  if (without_ == 0)
  {
    return {};
  }
  return { std::to_string(without_) +
    " points have no normal: they have fewer than three neighbours, or all are on one line." };
}

} // namespace pointfront
