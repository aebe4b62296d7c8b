#include "ColouredCloud.h"

#include "CloudInMemory.h"
#include "LASFormat.h"
#include "ProjCoordinateSystems.h"

#include <gtest/gtest.h>

#include <cstring>
#include <utility>

namespace pointfront::test
{
namespace
{

double valueAt(ScalarType type, const std::byte* p)
{
  return visitScalar(type,
    [p](auto value)
    {
      std::memcpy(&value, p, sizeof value);
      return static_cast<double>(value);
    });
}

} // namespace

std::vector<double> ColouredCloud::values(const std::string& name) const
{
  std::vector<double> all;
  const auto column = schema.find(name);
  EXPECT_TRUE(column) << name;
  const std::size_t bytes = sizeOf(schema[*column].type);
  for (std::size_t at = 0; at < points.columns[*column].size(); at += bytes)
  {
    const std::byte* p = points.columns[*column].data() + at;
    all.push_back(valueAt(schema[*column].type, p));
  }
  return all;
}

ColouredCloud coloured(std::unique_ptr<PointSource> source, std::vector<RasterInput> inputs)
{
  ColouredCloud outcome;
  PointSources sources;
  sources.push_back(std::move(source));
  const ImageValuesPass pass(std::move(inputs), std::make_shared<ProjCoordinateSystems>());
  PassResources resources;
  resources.memoryBytes = 1; // the least cache that there is
  Result<PointSources> result = pass.apply(std::move(sources), resources);
  if (!result)
  {
    outcome.error = result.error().what;
    return outcome;
  }
  const PointSource& ready = *result->front();
  outcome.schema = ready.description().schema;
  outcome.colourImage = ready.description().colourImage;
  for (std::uint64_t chunk = 0; chunk < ready.chunkCount(); ++chunk)
  {
    PointBatch batch;
    const Result<void> done = ready.read(chunk, batch);
    outcome.error += done ? "" : done.error().what;
    EXPECT_TRUE(ready.read(chunk, batch).ok() || !done); // twice: counted once
    outcome.points.append(batch);
  }
  for (const std::string& finding : pass.findings())
  {
    outcome.findings += finding + "\n";
  }
  return outcome;
}

std::unique_ptr<PointSource> opened(const std::string& path)
{
  auto source = LASFormat().open(path);
  EXPECT_TRUE(source.ok()) << (source ? "" : source.error().what);
  return source ? std::move(*source) : nullptr;
}

std::unique_ptr<PointSource> cloud(std::vector<glm::dvec3> points, const std::string& wkt)
{
  return std::make_unique<CloudInMemory>("cloud", std::move(points), wkt);
}

} // namespace pointfront::test
