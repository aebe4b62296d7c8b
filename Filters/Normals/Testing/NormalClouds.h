#pragma once

#include "NormalsPass.h"
#include "TestBuildClouds.h"

#include "pointfront/Points/AttributePass.h"
#include "pointfront/Points/NormalAttribute.h"

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace pointfront::test
{

using Positions = std::vector<glm::dvec3>;

/// The first three numbers of each line behind the line that begins with `header`; fails the test
/// when there are not `count` of them.
inline Positions textPositions(
  const std::string& name, const std::string& header, std::size_t count)
{
  std::ifstream file(std::string(POINTFRONT_SHARED_DATA) + "/normals/" + name);
  std::string line;
  while (std::getline(file, line) && line.rfind(header, 0) != 0)
  {
  }
  Positions positions;
  while (positions.size() < count && std::getline(file, line))
  {
    std::istringstream numbers(line);
    glm::dvec3 p(0.0);
    numbers >> p.x >> p.y >> p.z;
    positions.push_back(p);
  }
  EXPECT_EQ(positions.size(), count) << name << " is missing or short";
  return positions;
}

inline Positions bunny()
{
  return textPositions("bun0.pcd", "DATA ascii", 397);
}

inline PointSources sourcesOf(
  const Positions& positions, const std::vector<std::uint8_t>& classes = {})
{
  AttributeSchema schema;
  if (!classes.empty())
  {
    schema.add({ "classification", ScalarType::UInt8, 1 });
  }
  auto source = std::make_unique<CloudSource>("cloud", schema, std::nullopt, 1000);
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    source->addPosition(positions[i]);
    if (!classes.empty())
    {
      source->addValue(0, classes[i]);
    }
  }
  PointSources sources;
  sources.push_back(std::move(source));
  return sources;
}

/// Stored values of an attribute of all points in input order, T for each.
template <typename T>
std::vector<T> attributeOf(const PointSources& sources, const std::string& name)
{
  std::vector<T> values;
  for (const auto& source : sources)
  {
    const auto column = source->description().schema.find(name);
    EXPECT_TRUE(column) << name;
    PointBatch batch;
    for (std::uint64_t chunk = 0; column && chunk < source->chunkCount(); ++chunk)
    {
      EXPECT_TRUE(source->read(chunk, batch));
      const auto* first = reinterpret_cast<const T*>(batch.columns[*column].data());
      values.insert(values.end(), first, first + batch.size());
    }
  }
  return values;
}

inline PassResources testResources()
{
  PassResources resources;
  resources.threads = 2;
  resources.temporaryFolder = testing::TempDir();
  return resources;
}

/// Planes through so many nearest points.
inline NormalsOptions nearest(std::uint32_t neighbours)
{
  NormalsOptions options;
  options.neighbours = neighbours;
  return options;
}

/// Stored normals that a pass computes.
inline std::vector<PackedNormal> normalsBy(const AttributePass& pass, PointSources sources)
{
  Result<PointSources> result = pass.apply(std::move(sources), testResources());
  EXPECT_TRUE(result) << (result ? "" : result.error().what);
  return result ? attributeOf<PackedNormal>(*result, "normal") : std::vector<PackedNormal>();
}

/// Root of the mean squared angle between lines, degrees; vectors without length count as 90.
template <typename Vectors, typename Others>
double rmsDegrees(const Vectors& a, const Others& b)
{
  double sum = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    const glm::dvec3 u(a[i].x, a[i].y, a[i].z);
    const glm::dvec3 v(b[i].x, b[i].y, b[i].z);
    const double degrees =
      std::atan2(glm::length(glm::cross(u, v)), std::abs(glm::dot(u, v))) * 57.29577951308232;
    sum += glm::length(u) > 0.0 && glm::length(v) > 0.0 ? degrees * degrees : 8100.0;
  }
  return std::sqrt(sum / std::max<double>(1.0, double(a.size())));
}

} // namespace pointfront::test
