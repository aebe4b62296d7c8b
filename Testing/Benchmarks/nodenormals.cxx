// Normals that a LAS file drawn in place can have: points a second and angle to what is known, for
// each way to get them.
//
// usage: pointfrontNodeNormalsBenchmark [POINTS] [CLOUD.las]
// Shapes of about POINTS points (400,000), in the order of a scan, and the cloud, whose known
// normals are those of planes through 16 neighbours of all its points.

#include "IndexedLASFile.h"
#include "LASFormat.h"
#include "LASIndexing.h"
#include "LASWriter.h"
#include "NodePlanes.h"
#include "NormalsPass.h"
#include "ScanNormals.h"
#include "ScanNormalsPass.h"

#include "pointfront/InPlace/NodeNormals.h"

#include <glm/common.hpp>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <filesystem>
#include <functional>
#include <random>
#include <unordered_map>

namespace
{
using namespace pointfront;
using Vectors = std::vector<glm::dvec3>;
constexpr double degree = 57.29577951308232;

[[noreturn]] void giveUp(const std::string& what)
{
  std::fprintf(stderr, "%s\n", what.c_str());
  std::exit(1);
}

double cpuSeconds()
{
  return double(std::clock()) / CLOCKS_PER_SEC;
}

/// The known normal at a point of the file; zero where there is none.
using Known = std::function<glm::dvec3(const glm::dvec3&)>;

struct Cloud
{
  std::string name;
  std::string las;
  Known known;
};

std::string temporary(const std::string& name)
{
  return (std::filesystem::temp_directory_path() / ("node_normals_" + name)).string();
}

std::string write(const std::string& name, const Vectors& positions, double precision)
{
  const std::string las = temporary(name + ".las");
  SinkDescription description;
  description.grid = { glm::dvec3(precision), glm::floor(positions.front()) };
  LASWriter writer(las);
  PointBatch batch;
  batch.resize(positions.size(), description.schema);
  batch.positions = positions;
  if (!writer.begin(description) || !writer.append(batch) || !writer.finish())
  {
    giveUp("cannot write " + las);
  }
  return las;
}

/// A sphere of radius 100 without noise, in rings.
Cloud sphere(std::size_t points)
{
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> jitter(-0.2, 0.2);
  Vectors positions;
  const auto rings = static_cast<std::size_t>(std::sqrt(double(points) / 2.0));
  for (std::size_t r = 0; r < rings; ++r)
  {
    for (std::size_t i = 0; i < 2 * rings; ++i)
    {
      const double z = 2.0 * (double(r) + 0.5 + jitter(random)) / double(rings) - 1.0;
      const double a = (double(i) + jitter(random)) / double(rings) / degree * 180.0;
      const double s = std::sqrt(1.0 - z * z);
      positions.push_back(100.0 * glm::dvec3(s * std::cos(a), s * std::sin(a), z));
    }
  }
  return { "sphere", write("sphere", positions, 1e-5),
    [](const glm::dvec3& p) { return glm::normalize(p); } };
}

/// A tilted plane, scan lines 0.3 m apart, every point off by 1 cm (one sigma) along the normal.
Cloud noisyPlane(std::size_t points)
{
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> jitter(-0.05, 0.05);
  std::normal_distribution<double> noise(0.0, 0.01);
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, -0.2, 1.0));
  Vectors positions;
  const auto side = static_cast<std::size_t>(std::sqrt(double(points)));
  for (std::size_t i = 0; i < side * side; ++i)
  {
    const double x = 0.3 * double(i % side) + jitter(random);
    const double y = 0.3 * double(i / side) + jitter(random);
    positions.push_back(glm::dvec3(4e5, 5.6e6, 0.0) + glm::dvec3(x, y, (-0.3 * x + 0.2 * y)) +
      noise(random) * normal);
  }
  return { "plane, 1 cm noise", write("plane", positions, 1e-4),
    [normal](const glm::dvec3&) { return normal; } };
}

std::string keyOf(const glm::dvec3& p)
{
  return { reinterpret_cast<const char*>(&p), sizeof p };
}

/// Planes through 16 neighbours of all points.
Cloud realCloud(const std::string& las)
{
  auto source = LASFormat().open(las);
  if (!source)
  {
    giveUp(source.error().what);
  }
  PointSources sources;
  sources.push_back(std::move(*source));
  PassResources resources;
  resources.temporaryFolder = std::filesystem::temp_directory_path().string();
  const auto result = NormalsPass(NormalsOptions{}).apply(std::move(sources), resources);
  if (!result)
  {
    giveUp(result.error().what);
  }
  const PointSource& points = *result->front();
  const std::size_t column = *points.description().schema.find("normal");
  const auto normals = std::make_shared<std::unordered_map<std::string, PackedNormal>>();
  PointBatch batch;
  for (std::uint64_t chunk = 0; chunk < points.chunkCount(); ++chunk)
  {
    if (!points.read(chunk, batch))
    {
      giveUp("cannot read " + las);
    }
    for (std::size_t i = 0; i < batch.size(); ++i)
    {
      std::memcpy(&(*normals)[keyOf(batch.positions[i])],
        batch.columns[column].data() + i * sizeof(PackedNormal), sizeof(PackedNormal));
    }
  }
  return { "the cloud", las,
    [normals](const glm::dvec3& p)
    {
      const auto found = normals->find(keyOf(p));
      return found == normals->end() ? glm::dvec3(0.0) : unpackNormal(found->second);
    } };
}

/// Between lines: the sign of a normal plays no part.
struct Angles
{
  std::vector<double> degrees;
  std::size_t without = 0;

  void add(const PackedNormal& packed, const glm::dvec3& known)
  {
    const glm::dvec3 normal = unpackNormal(packed);
    if (known == glm::dvec3(0.0))
    {
      return;
    }
    if (normal == glm::dvec3(0.0))
    {
      ++without;
      return;
    }
    degrees.push_back(degree *
      std::atan2(glm::length(glm::cross(normal, known)), std::abs(glm::dot(normal, known))));
  }
  double rms() const
  {
    double sum = 0.0;
    for (const double angle : degrees)
    {
      sum += angle * angle;
    }
    return degrees.empty() ? 0.0 : std::sqrt(sum / double(degrees.size()));
  }
  double median()
  {
    if (degrees.empty())
    {
      return 0.0;
    }
    const auto middle = degrees.begin() + static_cast<std::ptrdiff_t>(degrees.size() / 2);
    std::nth_element(degrees.begin(), middle, degrees.end());
    return *middle;
  }
};

/// A way's estimate for all nodes of an index.
struct Estimate
{
  Angles leaves;
  Angles inner;
  double seconds = 0.0; ///< CPU, of the normals alone
  std::size_t points = 0;
  std::size_t nodes = 0;
};

/// A node's points in the order of a file.
struct NodePoints
{
  Vectors positions;
  bool leaf = false;
};

using Way = std::function<void(const Vectors& positions, std::vector<PackedNormal>& normals)>;

Estimate estimated(const std::vector<NodePoints>& nodes, const Way& way, const Known& known)
{
  Estimate estimate;
  std::vector<PackedNormal> normals;
  for (const NodePoints& node : nodes)
  {
    const double begin = cpuSeconds();
    way(node.positions, normals);
    estimate.seconds += cpuSeconds() - begin;
    estimate.points += node.positions.size();
    ++estimate.nodes;
    for (std::size_t i = 0; i < normals.size(); ++i)
    {
      (node.leaf ? estimate.leaves : estimate.inner).add(normals[i], known(node.positions[i]));
    }
  }
  return estimate;
}

void print(const Cloud& cloud, const std::string& way, Estimate estimate)
{
  Angles all = estimate.leaves;
  all.degrees.insert(
    all.degrees.end(), estimate.inner.degrees.begin(), estimate.inner.degrees.end());
  all.without += estimate.inner.without;
  std::printf("| %s | %s | %.0f | %.1f | %.2f | %.2f | %.2f | %.2f | %.2f |\n", cloud.name.c_str(),
    way.c_str(), 1e9 * estimate.seconds / double(estimate.points),
    1e3 * estimate.seconds / double(estimate.nodes), all.rms(), all.median(), estimate.leaves.rms(),
    estimate.inner.rms(), 100.0 * double(all.without) / double(estimate.points));
  std::fflush(stdout);
}

std::shared_ptr<const IndexedLASFile> indexed(
  const std::string& las, std::shared_ptr<const AttributePass> normals, double& seconds)
{
  LASIndexOptions options;
  options.overwrite = true;
  options.normals = std::move(normals);
  const std::string side = temporary("side.pfindex");
  const double begin = cpuSeconds();
  const auto report = indexLASFile(las, side, options);
  seconds = cpuSeconds() - begin;
  auto cloud = IndexedLASFile::open(side);
  if (!report || !cloud)
  {
    giveUp(report ? cloud.error().what : report.error().what);
  }
  return *cloud;
}

/// The nodes of an index, their points ascending by number.
std::vector<NodePoints> nodesOf(const IndexedLASFile& cloud, const std::string& side)
{
  const auto file = SideFile::open(side);
  const auto source = LASFormat().open(cloud.files().back());
  if (!file || !source)
  {
    giveUp("cannot open the index again");
  }
  Vectors all;
  PointBatch batch;
  for (std::uint64_t chunk = 0; chunk < (*source)->chunkCount(); ++chunk)
  {
    if ((*source)->read(chunk, batch))
    {
      all.insert(all.end(), batch.positions.begin(), batch.positions.end());
    }
  }
  std::vector<NodePoints> nodes;
  for (NodeIndex i = 0; i < cloud.hierarchy()->nodeCount(); ++i)
  {
    const auto points = (*file)->pointsOf(i);
    if (!points)
    {
      giveUp(points.error().what);
    }
    NodePoints node{ {}, cloud.hierarchy()->node(i).leaf() };
    for (const std::uint64_t point : *points)
    {
      node.positions.push_back(all[point]);
    }
    nodes.push_back(std::move(node));
  }
  return nodes;
}

/// Normals that the index holds.
void printHeld(
  const Cloud& cloud, const std::string& way, const IndexedLASFile& index, double seconds)
{
  Estimate estimate;
  estimate.seconds = seconds;
  const auto column = static_cast<std::uint32_t>(*index.description().schema.find("normal"));
  for (NodeIndex i = 0; i < index.hierarchy()->nodeCount(); ++i)
  {
    const auto node = index.read(i, { column });
    if (!node)
    {
      giveUp(node.error().what);
    }
    estimate.points += node->size();
    ++estimate.nodes;
    for (std::size_t p = 0; p < node->size(); ++p)
    {
      PackedNormal normal;
      std::memcpy(&normal, node->columns[0].data() + p * sizeof normal, sizeof normal);
      const glm::dvec3 position =
        index.description().grid.toWorld(node->origin + GridPosition(node->positions[p]));
      (index.hierarchy()->node(i).leaf() ? estimate.leaves : estimate.inner)
        .add(normal, cloud.known(position));
    }
  }
  print(cloud, way, std::move(estimate));
}

void compare(const Cloud& cloud)
{
  double without = 0.0;
  const auto plain = indexed(cloud.las, nullptr, without);
  const std::vector<NodePoints> nodes = nodesOf(*plain, plain->description().path);
  print(cloud, "load: scan neighbours in the node", estimated(nodes, scanNormals, cloud.known));
  for (const unsigned neighbours : { 3u, 6u, 8u, 16u, 32u })
  {
    const NodePlanes planes(neighbours);
    print(cloud, "load: planes through " + std::to_string(neighbours) + " in the node",
      estimated(
        nodes, [&](const Vectors& p, auto& n) { planes.compute(p, n); }, cloud.known));
  }
  double seconds = 0.0;
  const auto scan = indexed(cloud.las, std::make_shared<ScanNormalsPass>(std::nullopt), seconds);
  printHeld(cloud, "index: scanline", *scan, seconds - without);
  const auto pca = indexed(cloud.las, std::make_shared<NormalsPass>(NormalsOptions{}), seconds);
  printHeld(cloud, "index: pca, k = 16", *pca, seconds - without);
}
} // namespace

int main(int argc, char** argv)
{
  const std::size_t points =
    argc > 1 ? static_cast<std::size_t>(std::strtoull(argv[1], nullptr, 10)) : 400000;
  std::printf("| points | way | CPU, ns a point | CPU, ms a node | RMS, degrees | median "
              "| RMS in leaves | RMS in inner nodes | without a normal, %% |\n"
              "| --- | --- | ---: | ---: | ---: | ---: | ---: | ---: | ---: |\n");
  compare(sphere(points));
  compare(noisyPlane(points));
  if (argc > 2)
  {
    compare(realCloud(argv[2]));
  }
  return 0;
}
