// Normals: points a second and angle to what is known, for each way to estimate them.
//
// usage: pointfrontNormalsBenchmark [POINTS] [CLOUD.las]
// Shapes of about POINTS points (1,000,000), in the order of a scan. With a cloud, also the angles
// to what pcl::NormalEstimationOMP gives for it (exact): of as many neighbours, and of 16.

#include "LASFormat.h"
#include "NormalsPass.h"
#include "ScanNormalsPass.h"

#include "pointfront/Generate/TerrainModel.h"
#include "pointfront/Generate/TerrainSource.h"
#include "pointfront/Points/NormalAttribute.h"

#include <glm/common.hpp>
#include <pcl/features/normal_3d_omp.h>
#include <pcl/search/kdtree.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <map>
#include <random>

namespace
{
using namespace pointfront;

constexpr double degree = 57.29577951308232;
using Vectors = std::vector<glm::dvec3>;

/// Points in memory, 50,000 a chunk.
class MemorySource final : public PointSource
{
public:
  explicit MemorySource(const Vectors& positions)
    : positions_(positions)
  {
    description_.pointCount = positions.size();
  }
  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return (positions_.size() + 49999) / 50000; }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override
  {
    return std::min<std::uint64_t>(50000, positions_.size() - chunk * 50000);
  }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    const auto first = positions_.begin() + static_cast<std::ptrdiff_t>(chunk * 50000);
    batch.resize(chunkPoints(chunk), description_.schema);
    std::copy_n(first, batch.size(), batch.positions.begin());
    return {};
  }

private:
  const Vectors& positions_;
  SourceDescription description_;
};

struct Shape
{
  std::string name;
  Vectors positions;
  Vectors normals; ///< known; zero where there is none
};

/// A unit sphere without noise, in rings.
Shape sphere(std::size_t points)
{
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> jitter(-0.2, 0.2);
  Shape shape{ "sphere", {}, {} };
  const auto rings = static_cast<std::size_t>(std::sqrt(double(points) / 2.0));
  for (std::size_t r = 0; r < rings; ++r)
  {
    for (std::size_t i = 0; i < 2 * rings; ++i)
    {
      const double z = 2.0 * (double(r) + 0.5 + jitter(random)) / double(rings) - 1.0;
      const double a = (double(i) + jitter(random)) / double(rings) / degree * 180.0;
      const double s = std::sqrt(1.0 - z * z);
      shape.normals.emplace_back(s * std::cos(a), s * std::sin(a), z);
    }
  }
  shape.positions = shape.normals;
  return shape;
}

/// A tilted plane, scan lines 0.3 m apart, every point off by 1 cm (one sigma) along the normal.
Shape noisyPlane(std::size_t points)
{
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> jitter(-0.05, 0.05);
  std::normal_distribution<double> noise(0.0, 0.01);
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, -0.2, 1.0));
  Shape shape{ "plane, 1 cm noise", {}, {} };
  const auto side = static_cast<std::size_t>(std::sqrt(double(points)));
  for (std::size_t i = 0; i < side * side; ++i)
  {
    const double x = 0.3 * double(i % side) + jitter(random);
    const double y = 0.3 * double(i / side) + jitter(random);
    const glm::dvec3 p(x, y, (-0.3 * x + 0.2 * y));
    shape.positions.push_back(glm::dvec3(4e5, 5.6e6, 0.0) + p + noise(random) * normal);
    shape.normals.push_back(normal);
  }
  return shape;
}

/// The made-up survey; known on the bare ground only.
Shape terrain(std::size_t points)
{
  const TerrainSource source(points, 7);
  const TerrainModel model(7);
  const glm::dvec3 origin = source.description().grid->offset;
  const std::size_t classes = *source.description().schema.find("classification");
  Shape shape{ "generated terrain, ground", {}, {} };
  PointBatch batch;
  for (std::uint64_t chunk = 0; chunk < source.chunkCount(); ++chunk)
  {
    if (!source.read(chunk, batch))
    {
      std::exit(1);
    }
    for (std::size_t i = 0; i < batch.size(); ++i)
    {
      const glm::dvec3& p = batch.positions[i];
      const double x = p.x - origin.x;
      const double y = p.y - origin.y;
      const double h = 0.05;
      const glm::dvec3 n(model.groundHeight(x - h, y) - model.groundHeight(x + h, y),
        model.groundHeight(x, y - h) - model.groundHeight(x, y + h), 2.0 * h);
      const bool ground = batch.columns[classes][i] == std::byte(TerrainModel::Ground);
      shape.positions.push_back(p);
      shape.normals.push_back(ground ? glm::normalize(n) : glm::dvec3(0.0));
    }
  }
  return shape;
}

struct Estimate
{
  Vectors normals;
  double seconds = 0.0;
  double cpuSeconds = 0.0; ///< time of all threads: a busy machine does not change it much
};

/// Measures its life.
class Stopwatch
{
public:
  void stop(Estimate& estimate) const
  {
    estimate.seconds =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - begin_).count();
    estimate.cpuSeconds = double(std::clock() - cpuBegin_) / CLOCKS_PER_SEC;
  }

private:
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::clock_t cpuBegin_ = std::clock();
};

double pointsASecond(const Estimate& estimate)
{
  return double(estimate.normals.size()) / estimate.seconds;
}

double nanosecondsAPoint(const Estimate& estimate)
{
  return estimate.cpuSeconds / double(estimate.normals.size()) * 1e9;
}

/// From the first reading to the last: the normals of all points in input order.
Estimate estimated(const AttributePass& pass, const Vectors& positions)
{
  PointSources sources;
  sources.push_back(std::make_unique<MemorySource>(positions));
  PassResources resources;
  resources.temporaryFolder = std::filesystem::temp_directory_path().string();
  const Stopwatch watch;
  const Result<PointSources> result = pass.apply(std::move(sources), resources);
  if (!result)
  {
    std::fprintf(stderr, "%s\n", result.error().what.c_str());
    std::exit(1);
  }
  Estimate estimate;
  PointBatch batch;
  const std::size_t normals = *result->front()->description().schema.find("normal");
  for (std::uint64_t chunk = 0; chunk < result->front()->chunkCount(); ++chunk)
  {
    if (!result->front()->read(chunk, batch))
    {
      std::exit(1);
    }
    for (std::size_t i = 0; i < batch.size(); ++i)
    {
      PackedNormal packed;
      std::memcpy(&packed, batch.columns[normals].data() + i * sizeof packed, sizeof packed);
      estimate.normals.push_back(unpackNormal(packed));
    }
  }
  watch.stop(estimate);
  return estimate;
}

/// Between lines: the sign of a normal plays no part.
struct Angles
{
  double rms = 0.0; ///< degrees
  double most95 = 0.0; ///< degrees; 95 % are no larger
  double without = 0.0; ///< share of the known ones that have no normal
};

/// Where something is known.
Angles anglesBetween(const Vectors& normals, const Vectors& known)
{
  std::vector<double> degrees;
  double squares = 0.0;
  std::size_t without = 0;
  for (std::size_t i = 0; i < known.size(); ++i)
  {
    if (known[i] == glm::dvec3(0.0))
    {
      continue;
    }
    if (normals[i] == glm::dvec3(0.0))
    {
      ++without;
      continue;
    }
    const double angle = degree *
      std::atan2(
        glm::length(glm::cross(normals[i], known[i])), std::abs(glm::dot(normals[i], known[i])));
    degrees.push_back(angle);
    squares += angle * angle;
  }
  if (degrees.empty())
  {
    return {};
  }
  const auto rank = static_cast<std::ptrdiff_t>(0.95 * double(degrees.size()));
  std::nth_element(degrees.begin(), degrees.begin() + rank, degrees.end());
  return { std::sqrt(squares / double(degrees.size())), degrees[static_cast<std::size_t>(rank)],
    double(without) / double(degrees.size() + without) };
}

struct Method
{
  std::string name;
  unsigned neighbours = 0; ///< 0: not of the k nearest
  std::unique_ptr<AttributePass> pass;
};

std::vector<Method> methods()
{
  std::vector<Method> all;
  all.push_back({ "scan neighbours", 0, std::make_unique<ScanNormalsPass>(std::nullopt) });
  const std::pair<unsigned, double> settings[] = { { 8, 0.0 }, { 16, 0.0 }, { 32, 0.0 },
    { 16, 0.5 }, { 16, 2.0 }, { 8, 2.0 } };
  for (const auto& [neighbours, eps] : settings)
  {
    NormalsOptions options;
    options.neighbours = neighbours;
    options.eps = eps;
    char name[64];
    std::snprintf(name, sizeof name, "PCA k = %u, eps = %g", neighbours, eps);
    all.push_back({ name, neighbours, std::make_unique<NormalsPass>(options) });
  }
  return all;
}

Vectors lasPositions(const std::string& path)
{
  const auto source = LASFormat().open(path);
  Vectors positions;
  PointBatch batch;
  for (std::uint64_t chunk = 0; source && chunk < (*source)->chunkCount(); ++chunk)
  {
    if ((*source)->read(chunk, batch))
    {
      positions.insert(positions.end(), batch.positions.begin(), batch.positions.end());
    }
  }
  return positions;
}

/// PCL's normals by the exact k nearest, in its own float relative to the middle of the cloud.
Estimate estimatedByPCL(const Vectors& positions, int neighbours)
{
  Bounds bounds;
  for (const glm::dvec3& p : positions)
  {
    bounds.add(p);
  }
  const Stopwatch watch;
  const auto cloud = pcl::make_shared<pcl::PointCloud<pcl::PointXYZ>>();
  for (const glm::dvec3& p : positions)
  {
    const glm::vec3 q(p - bounds.centre());
    cloud->push_back({ q.x, q.y, q.z });
  }
  pcl::NormalEstimationOMP<pcl::PointXYZ, pcl::Normal> estimation;
  estimation.setInputCloud(cloud);
  estimation.setSearchMethod(pcl::make_shared<pcl::search::KdTree<pcl::PointXYZ>>());
  estimation.setKSearch(neighbours);
  pcl::PointCloud<pcl::Normal> normals;
  estimation.compute(normals);
  Estimate estimate;
  watch.stop(estimate);
  for (const pcl::Normal& n : normals)
  {
    estimate.normals.emplace_back(n.normal_x, n.normal_y, n.normal_z);
  }
  return estimate;
}

/// PCL's own rows first: its rate and ours are of one run.
void compareWithPCL(const std::string& path)
{
  const Vectors positions = lasPositions(path);
  std::printf("\n%zu points of the cloud\n", positions.size());
  std::printf("| way | M points/s | CPU, ns a point | PCL's to it | RMS to PCL of its k, degrees "
              "| 95 %% | RMS to PCL, k = 16 | 95 %% | without a normal, %% |\n"
              "| --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  std::map<unsigned, Estimate> pcl;
  for (const unsigned neighbours : { 8u, 16u, 32u })
  {
    pcl[neighbours] = estimatedByPCL(positions, static_cast<int>(neighbours));
  }
  const auto print = [&pcl](const std::string& name, unsigned neighbours, const Estimate& estimate)
  {
    std::printf("| %s | %.2f | %.0f |", name.c_str(), 1e-6 * pointsASecond(estimate),
      nanosecondsAPoint(estimate));
    if (const auto same = pcl.find(neighbours); same != pcl.end())
    {
      const Angles angles = anglesBetween(estimate.normals, same->second.normals);
      std::printf(" %.2f | %.3f | %.3f |", same->second.cpuSeconds / estimate.cpuSeconds,
        angles.rms, angles.most95);
    }
    else
    {
      std::printf(" \u2013 | \u2013 | \u2013 |");
    }
    const Angles angles = anglesBetween(estimate.normals, pcl[16].normals);
    std::printf(" %.3f | %.3f | %.2f |\n", angles.rms, angles.most95, 100.0 * angles.without);
    std::fflush(stdout);
  };
  for (const auto& [neighbours, estimate] : pcl)
  {
    print("pcl::NormalEstimationOMP, k = " + std::to_string(neighbours), neighbours, estimate);
  }
  for (const Method& method : methods())
  {
    print(method.name, method.neighbours, estimated(*method.pass, positions));
  }
}
} // namespace

int main(int argc, char** argv)
{
  const std::size_t points =
    argc > 1 ? static_cast<std::size_t>(std::strtoull(argv[1], nullptr, 10)) : 1000000;
  std::printf("| shape | way | CPU, ns a point | RMS, degrees | 95 %%, degrees "
              "| without a normal, %% |\n| --- | --- | ---: | ---: | ---: | ---: |\n");
  for (const Shape& shape : { sphere(points), noisyPlane(points), terrain(points) })
  {
    for (const Method& method : methods())
    {
      const Estimate estimate = estimated(*method.pass, shape.positions);
      const Angles angles = anglesBetween(estimate.normals, shape.normals);
      std::printf("| %s | %s | %.0f | %.3f | %.3f | %.2f |\n", shape.name.c_str(),
        method.name.c_str(), nanosecondsAPoint(estimate), angles.rms, angles.most95,
        100.0 * angles.without);
      std::fflush(stdout);
    }
  }
  if (argc > 2)
  {
    compareWithPCL(argv[2]);
  }
  return 0;
}
