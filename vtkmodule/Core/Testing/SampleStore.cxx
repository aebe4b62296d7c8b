#include "SampleStore.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <random>

namespace pointfront
{
namespace
{
// Not std::uniform_int_distribution: its results differ from library to library.
std::uint64_t next(std::mt19937_64& random, std::uint64_t limit)
{
  return random() % limit;
}

AttributeSchema sampleSchema()
{
  AttributeSchema schema;
  schema.add({ "rgb", ScalarType::UInt8, 3 });
  schema.add({ "intensity", ScalarType::UInt16, 1 });
  schema.add({ "classification", ScalarType::UInt8, 1 });
  schema.add({ "gps_time", ScalarType::Float64, 1 });
  schema.add({ "normal", ScalarType::Float32, 3 });
  schema.add({ "shift", ScalarType::Int32, 2, 0.01, 5.0, "an extra dimension" });
  schema.add({ "tiny", ScalarType::Int8, 1 });
  schema.add({ "small", ScalarType::Int16, 1 });
  schema.add({ "count", ScalarType::UInt32, 1 });
  schema.add({ "long", ScalarType::Int64, 1 });
  schema.add({ "identity", ScalarType::UInt64, 1 });
  schema.add({ "repeated", ScalarType::UInt8, 1 });
  return schema;
}

template <typename T>
void put(std::vector<std::byte>& column, T value)
{
  const std::size_t at = column.size();
  column.resize(at + sizeof(T));
  std::memcpy(column.data() + at, &value, sizeof(T));
}

NodeColumns samplePoints(NodeIndex node, std::uint32_t count, std::mt19937_64& random)
{
  NodeColumns points;
  points.node = node;
  points.origin = { std::int64_t(node) * 40000 - 60000, 7000, -300 };
  points.columns.resize(sampleSchema().size());
  auto& c = points.columns;
  for (std::uint32_t i = 0; i < count; ++i)
  {
    points.positions.emplace_back(next(random, 30000), i * 7, next(random, 500));
    for (int channel = 0; channel < 3; ++channel)
    {
      put(c[0], static_cast<std::uint8_t>(100 + next(random, 40)));
    }
    put(c[1], static_cast<std::uint16_t>(next(random, 4000)));
    put(c[2], static_cast<std::uint8_t>(node < 5 ? 2 : 6));
    const bool unknown = i % 11 == 3;
    put(c[3], unknown ? std::numeric_limits<double>::quiet_NaN() : 1e5 + i * 0.25);
    for (int axis = 0; axis < 3; ++axis)
    {
      put(c[4], static_cast<float>(next(random, 2001)) / 1000.0f - 1.0f);
    }
    put(c[5], static_cast<std::int32_t>(next(random, 100)) - 50);
    put(c[5], std::numeric_limits<std::int32_t>::min() + static_cast<std::int32_t>(i));
    put(c[6], static_cast<std::int8_t>(next(random, 256)));
    put(c[7], static_cast<std::int16_t>(next(random, 65536)));
    put(c[8], static_cast<std::uint32_t>(random()));
    put(c[9], static_cast<std::int64_t>(random() >> 20) - (std::int64_t(1) << 40));
    put(c[10], static_cast<std::uint64_t>(random() >> 12));
    put(c[11], static_cast<std::uint8_t>(i % 50 * 181));
  }
  points.selection = everyColumn(sampleSchema());
  return points;
}

Bounds boxOf(const NodeColumns& points, const QuantisationGrid& grid)
{
  Bounds box;
  for (const glm::u32vec3& p : points.positions)
  {
    box.add(grid.toWorld(points.origin + GridPosition(p)));
  }
  return box;
}

float roundedUp(double value)
{
  const auto nearest = static_cast<float>(value);
  return std::nextafter(nearest, std::numeric_limits<float>::infinity());
}

// From the last node to the first: every child before its parent.
void measure(SampleStore& sample)
{
  std::vector<Bounds> boxes(sample.nodes.size());
  for (std::size_t i = sample.nodes.size(); i-- > 0;)
  {
    Node& node = sample.nodes[i];
    boxes[i].add(boxOf(sample.points[i], sample.description.grid));
    node.pointCount = static_cast<std::uint32_t>(sample.points[i].size());
    node.pointsBelow = node.pointCount;
    for (std::uint32_t k = 0; k < node.childCount; ++k)
    {
      boxes[i].add(boxes[node.firstChild + k]);
      node.pointsBelow += sample.nodes[node.firstChild + k].pointsBelow;
    }
    if (boxes[i].empty())
    {
      boxes[i] = Bounds{ glm::dvec3(0.0), glm::dvec3(0.0) };
    }
    node.centre = boxes[i].centre();
    const glm::dvec3 half = boxes[i].high - node.centre;
    for (int axis = 0; axis < 3; ++axis)
    {
      node.halfSize[axis] = roundedUp(half[axis]);
    }
    node.radius = roundedUp(glm::length(half));
    node.spacing = 4.0f / static_cast<float>(1 << node.level);
    node.splatRadius = i == 3 ? 0.0f : 0.8f * node.spacing;
  }
}

Node linked(NodeIndex parent, NodeIndex firstChild, int childCount, int level, int layer)
{
  Node node;
  node.parent = parent;
  node.firstChild = firstChild;
  node.childCount = static_cast<std::uint8_t>(childCount);
  node.level = static_cast<std::uint8_t>(level);
  node.layer = static_cast<std::uint16_t>(layer);
  return node;
}
} // namespace

SampleStore makeSample(std::uint32_t pointsPerNode, std::uint64_t seed)
{
  SampleStore sample;
  sample.nodes = { linked(noNode, 2, 2, 0, 0), linked(noNode, 4, 1, 0, 1), linked(0, 5, 2, 1, 0),
    linked(0, noNode, 0, 1, 0), linked(1, noNode, 0, 1, 1), linked(2, noNode, 0, 2, 0),
    linked(2, noNode, 0, 2, 0) };
  sample.roots = { 0, 1 };
  StoreDescription& d = sample.description;
  d.grid.scale = { 0.01, 0.01, 0.005 };
  d.grid.offset = { 636000.0, 850000.0, 400.0 };
  d.crsWkt = "LOCAL_CS[\"sample\"]";
  d.structure = "octree";
  d.schema = sampleSchema();
  d.layers = { { 2, "ground", 0, 0 }, { 6, "building", 0, 0 } };
  d.generator = "sample";
  d.splatRadiusBase = 0.25;
  d.metadata = { { "LASF_Projection", 2112, "OGC WKT", { std::byte(1), std::byte(0) } },
    { "empty", 7, "", {} } };
  std::mt19937_64 random(seed);
  for (NodeIndex i = 0; i < sample.nodes.size(); ++i)
  {
    sample.points.push_back(samplePoints(i, i == 1 ? 0 : pointsPerNode, random));
  }
  measure(sample);
  return sample;
}

Result<void> writeSample(const SampleStore& sample, StoreWriter& writer)
{
  std::vector<StoreWriter::PayloadId> payloads;
  for (const NodeColumns& points : sample.points)
  {
    Result<StoreWriter::PayloadId> id =
      writer.append(encodeNode(points, sample.description.schema));
    if (!id)
    {
      return id.error();
    }
    payloads.push_back(*id);
  }
  return writer.commit(sample.description, sample.nodes, sample.roots, payloads);
}

void writeSample(const SampleStore& sample, const std::string& path)
{
  auto writer = StoreWriter::create(path, sample.description.schema);
  ASSERT_TRUE(writer) << writer.error().what;
  const Result<void> done = writeSample(sample, **writer);
  ASSERT_TRUE(done) << done.error().what;
}

ColumnSelection everyColumn(const AttributeSchema& schema)
{
  ColumnSelection columns;
  for (std::uint32_t c = 0; c < schema.size(); ++c)
  {
    columns.push_back(c);
  }
  return columns;
}

std::vector<std::byte> fileBytes(const std::string& path)
{
  std::ifstream file(path, std::ios::binary | std::ios::ate);
  std::vector<std::byte> bytes(static_cast<std::size_t>(file.tellg()));
  file.seekg(0);
  file.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  EXPECT_TRUE(file.good()) << path;
  return bytes;
}

void writeFile(const std::string& path, const std::vector<std::byte>& bytes)
{
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(
    reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  EXPECT_TRUE(file.good()) << path;
}

std::string temporaryPath(const std::string& name)
{
  // One folder a process: two runs of the tests at once do not meet. Removed at the end.
  struct Folder
  {
    std::string path = testing::TempDir() + "pointfront-XXXXXX";
    Folder() { EXPECT_NE(mkdtemp(path.data()), nullptr) << path; }
    ~Folder()
    {
      std::error_code ignored;
      std::filesystem::remove_all(path, ignored);
    }
  };
  static const Folder folder;
  const testing::TestInfo& test = *testing::UnitTest::GetInstance()->current_test_info();
  std::string file = std::string(test.test_suite_name()) + "_" + test.name() + "_" + name;
  std::replace(file.begin(), file.end(), '/', '_');
  return folder.path + "/" + file;
}

} // namespace pointfront
