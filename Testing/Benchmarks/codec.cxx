// Points decoded per second and core, and bytes a point, of ways to code the blocks of a store.
//   pointfrontCodecBenchmark [FILE.las|FILE.laz] [--benchmark_...]
// Without a file: a synthetic terrain. docs/adr/0001-store-codecs.md quotes it.

#include "LASFormat.h"

#include "pointfront/Codec/BlockCodec.h"
#include "pointfront/Codec/PackedCodec.h"
#include "pointfront/Codec/PlaneCodec.h"

#include <benchmark/benchmark.h>
#include <lz4.h>
#include <meshoptimizer.h>
#include <zstd.h>

#include <glm/common.hpp>
#include <glm/vec3.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <functional>
#include <memory>
#include <random>
#include <string>
#include <vector>

namespace
{
using namespace pointfront;
using Bytes = std::vector<std::byte>;

constexpr std::size_t nodePoints = 16384;
constexpr std::size_t maxNodes = 100; ///< spread evenly over the cloud

/// The values of one column, node after node.
struct Column
{
  std::string name;
  unsigned components = 1;
  unsigned scalarBytes = 1;
  std::vector<Bytes> nodes;

  BlockShape shape(std::size_t node) const
  {
    return { nodes[node].size() / (std::size_t(components) * scalarBytes), components,
      scalarBytes };
  }
};

struct Candidate
{
  std::string name;
  std::function<Bytes(const Bytes&, const BlockShape&)> encode;
  std::function<bool(const Bytes&, const BlockShape&, Bytes&)> decode;
};

// --- points

/// Positions on the grid and attribute bytes, as many as there are points.
struct Cloud
{
  std::vector<glm::u32vec3> positions;
  std::vector<Column> attributes; // one "node" each: the whole cloud
};

Cloud syntheticTerrain(std::size_t count)
{
  std::mt19937_64 random(1);
  Cloud cloud;
  cloud.attributes = { { "rgb", 3, 1, { {} } }, { "intensity", 1, 2, { {} } } };
  for (std::size_t i = 0; i < count; ++i)
  {
    const auto x = static_cast<double>(random() % 200000);
    const auto y = static_cast<double>(random() % 200000);
    const double hill = 3000.0 * std::sin(x / 40000.0) * std::cos(y / 30000.0);
    const double roof = std::fmod(x, 5000.0) < 1500.0 && std::fmod(y, 7000.0) < 2000.0 ? 800 : 0;
    const double tree = random() % 4 == 0 ? static_cast<double>(random() % 900) : 0.0;
    const auto noise = static_cast<double>(random() % 7);
    cloud.positions.emplace_back(x, y, 4000.0 + hill + roof + tree + noise);
    const auto shade = static_cast<unsigned>(80 + 40 * std::sin(x / 900.0) + (roof > 0 ? 60 : 0));
    for (unsigned channel = 0; channel < 3; ++channel)
    {
      const auto value = shade + channel * 7 + static_cast<unsigned>(random() % 12);
      cloud.attributes[0].nodes[0].push_back(static_cast<std::byte>(value));
    }
    const auto intensity = static_cast<std::uint16_t>(shade + random() % 40);
    cloud.attributes[1].nodes[0].push_back(static_cast<std::byte>(intensity & 0xff));
    cloud.attributes[1].nodes[0].push_back(static_cast<std::byte>(intensity >> 8));
  }
  return cloud;
}

Result<Cloud> readCloud(const std::string& path)
{
  Result<std::unique_ptr<PointSource>> source = LASFormat().open(path);
  if (!source)
  {
    return source.error();
  }
  const SourceDescription& description = (*source)->description();
  Cloud cloud;
  for (const Attribute& a : description.schema)
  {
    cloud.attributes.push_back(
      { a.name, a.components, static_cast<unsigned>(sizeOf(a.type)), { {} } });
  }
  const QuantisationGrid grid = description.grid.value_or(QuantisationGrid{});
  std::vector<GridPosition> positions;
  PointBatch batch;
  for (std::uint64_t chunk = 0; chunk < (*source)->chunkCount(); ++chunk)
  {
    if (Result<void> done = (*source)->read(chunk, batch); !done)
    {
      return done.error();
    }
    for (const glm::dvec3& p : batch.positions)
    {
      positions.push_back(grid.toGrid(p));
    }
    for (std::size_t c = 0; c < batch.columns.size(); ++c)
    {
      Bytes& all = cloud.attributes[c].nodes[0];
      all.insert(all.end(), batch.columns[c].begin(), batch.columns[c].end());
    }
  }
  GridPosition low(INT64_MAX);
  for (const GridPosition& p : positions)
  {
    low = glm::min(low, p);
  }
  for (const GridPosition& p : positions)
  {
    cloud.positions.emplace_back(p - low);
  }
  return cloud;
}

std::uint64_t spreadBits(std::uint64_t v)
{
  v &= 0x1fffff;
  v = (v | v << 32) & 0x1f00000000ffffull;
  v = (v | v << 16) & 0x1f0000ff0000ffull;
  v = (v | v << 8) & 0x100f00f00f00f00full;
  v = (v | v << 4) & 0x10c30c30c30c30c3ull;
  return (v | v << 2) & 0x1249249249249249ull;
}

std::uint64_t mortonCode(const glm::u32vec3& p)
{
  return spreadBits(p.x) | spreadBits(p.y) << 1 | spreadBits(p.z) << 2;
}

/// Cuts a cloud into nodes of neighbours and orders each as a store's builder does: batches that
/// double in size, each in Morton order.
std::vector<Column> asNodes(const Cloud& cloud)
{
  using Ranked = std::pair<std::uint64_t, std::uint32_t>;
  std::vector<Ranked> order;
  for (std::size_t i = 0; i < cloud.positions.size(); ++i)
  {
    order.emplace_back(mortonCode(cloud.positions[i]), static_cast<std::uint32_t>(i));
  }
  std::sort(order.begin(), order.end());
  std::vector<Column> columns{ { "positions", 3, 4, {} } };
  for (const Column& attribute : cloud.attributes)
  {
    columns.push_back({ attribute.name, attribute.components, attribute.scalarBytes, {} });
  }
  std::mt19937_64 random(2);
  const std::size_t stride = (order.size() / nodePoints / maxNodes + 1) * nodePoints;
  for (std::size_t begin = 0; begin + nodePoints <= order.size(); begin += stride)
  {
    const auto first = order.begin() + static_cast<std::ptrdiff_t>(begin);
    std::shuffle(first, first + nodePoints, random);
    for (std::size_t from = 0, to = 128; from < nodePoints; from = to, to *= 2)
    {
      std::sort(first + static_cast<std::ptrdiff_t>(from), first + static_cast<std::ptrdiff_t>(to));
    }
    glm::u32vec3 low(UINT32_MAX);
    for (auto it = first; it != first + nodePoints; ++it)
    {
      low = glm::min(low, cloud.positions[it->second]);
    }
    for (std::size_t c = 0; c < columns.size(); ++c)
    {
      const std::size_t step = std::size_t(columns[c].components) * columns[c].scalarBytes;
      Bytes& node = columns[c].nodes.emplace_back(nodePoints * step);
      for (std::size_t i = 0; i < nodePoints; ++i)
      {
        const std::size_t point = order[begin + i].second;
        const glm::u32vec3 position = cloud.positions[point] - low;
        const void* from = c == 0 ? static_cast<const void*>(&position)
                                  : cloud.attributes[c - 1].nodes[0].data() + point * step;
        std::memcpy(node.data() + i * step, from, step);
      }
    }
  }
  return columns;
}

// --- ways to code

Bytes zstd(const Bytes& bytes, int level)
{
  Bytes coded(ZSTD_compressBound(bytes.size()));
  coded.resize(ZSTD_compress(coded.data(), coded.size(), bytes.data(), bytes.size(), level));
  return coded;
}

Bytes planesOf(const Bytes& values, const BlockShape& shape)
{
  Bytes planes(shape.bytes());
  splitPlanes(values.data(), shape, planes.data());
  return planes;
}

/// meshoptimizer wants vertices of a multiple of four bytes.
std::size_t vertexBytes(const BlockShape& shape)
{
  return (shape.pointBytes() + 3) / 4 * 4;
}

Bytes meshEncode(const Bytes& values, const BlockShape& shape)
{
  const std::size_t stride = vertexBytes(shape);
  Bytes vertices(shape.points * stride);
  for (std::size_t i = 0; i < shape.points; ++i)
  {
    std::memcpy(&vertices[i * stride], &values[i * shape.pointBytes()], shape.pointBytes());
  }
  Bytes coded(meshopt_encodeVertexBufferBound(shape.points, stride));
  coded.resize(meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(coded.data()),
    coded.size(), vertices.data(), shape.points, stride));
  return coded;
}

bool meshDecode(const Bytes& coded, const BlockShape& shape, Bytes& values)
{
  const std::size_t stride = vertexBytes(shape);
  thread_local Bytes vertices;
  vertices.resize(shape.points * stride);
  const bool direct = stride == shape.pointBytes();
  const int failed = meshopt_decodeVertexBuffer(direct ? values.data() : vertices.data(),
    shape.points, stride, reinterpret_cast<const unsigned char*>(coded.data()), coded.size());
  for (std::size_t i = 0; !direct && i < shape.points; ++i)
  {
    std::memcpy(&values[i * shape.pointBytes()], &vertices[i * stride], shape.pointBytes());
  }
  return failed == 0;
}

Candidate chosenByStore()
{
  return { "store",
    [](const Bytes& values, const BlockShape& shape)
    {
      CodedBlock block = encodeBlock(values.data(), shape);
      block.bytes.push_back(static_cast<std::byte>(block.codec));
      return block.bytes;
    },
    [](const Bytes& coded, const BlockShape& shape, Bytes& values)
    {
      return decodeBlock(static_cast<BlockCodec>(coded.back()), coded.data(), coded.size() - 1,
        shape, values.data());
    } };
}

Candidate raw()
{
  return { "raw", [](const Bytes& values, const BlockShape&) { return values; },
    [](const Bytes& coded, const BlockShape&, Bytes& values)
    {
      std::memcpy(values.data(), coded.data(), coded.size());
      return true;
    } };
}

Candidate packed()
{
  return { "packed",
    [](const Bytes& values, const BlockShape& shape) { return encodePacked(values.data(), shape); },
    [](const Bytes& coded, const BlockShape& shape, Bytes& values)
    { return decodePacked(coded.data(), coded.size(), shape, values.data()); } };
}

Candidate planesZstd(int level)
{
  return { "planes+zstd" + std::to_string(level),
    [level](const Bytes& values, const BlockShape& shape)
    { return zstd(planesOf(values, shape), level); },
    [](const Bytes& coded, const BlockShape& shape, Bytes& values)
    { return decodePlanes(coded.data(), coded.size(), shape, values.data()); } };
}

Candidate planesLz4()
{
  return { "planes+lz4",
    [](const Bytes& values, const BlockShape& shape)
    {
      const Bytes planes = planesOf(values, shape);
      Bytes coded(static_cast<std::size_t>(LZ4_compressBound(static_cast<int>(planes.size()))));
      coded.resize(static_cast<std::size_t>(LZ4_compress_default(
        reinterpret_cast<const char*>(planes.data()), reinterpret_cast<char*>(coded.data()),
        static_cast<int>(planes.size()), static_cast<int>(coded.size()))));
      return coded;
    },
    [](const Bytes& coded, const BlockShape& shape, Bytes& values)
    {
      thread_local Bytes planes;
      planes.resize(shape.bytes());
      const int size = LZ4_decompress_safe(reinterpret_cast<const char*>(coded.data()),
        reinterpret_cast<char*>(planes.data()), static_cast<int>(coded.size()),
        static_cast<int>(planes.size()));
      joinPlanes(planes.data(), shape, values.data());
      return size == static_cast<int>(shape.bytes());
    } };
}

Candidate meshoptimizer(bool thenZstd)
{
  return { thenZstd ? "meshopt+zstd1" : "meshopt",
    [thenZstd](const Bytes& values, const BlockShape& shape)
    {
      const Bytes coded = meshEncode(values, shape);
      return thenZstd ? zstd(coded, 1) : coded;
    },
    [thenZstd](const Bytes& coded, const BlockShape& shape, Bytes& values)
    {
      if (!thenZstd)
      {
        return meshDecode(coded, shape, values);
      }
      thread_local Bytes inner;
      inner.resize(ZSTD_getFrameContentSize(coded.data(), coded.size()));
      const std::size_t size =
        ZSTD_decompress(inner.data(), inner.size(), coded.data(), coded.size());
      return !ZSTD_isError(size) && meshDecode(inner, shape, values);
    } };
}

// --- measuring

void decodeColumns(
  benchmark::State& state, const Candidate& candidate, const std::vector<const Column*>& columns)
{
  std::vector<std::vector<Bytes>> coded(columns.size());
  std::size_t codedBytes = 0;
  const std::size_t nodes = columns[0]->nodes.size();
  for (std::size_t c = 0; c < columns.size(); ++c)
  {
    for (std::size_t i = 0; i < nodes; ++i)
    {
      coded[c].push_back(candidate.encode(columns[c]->nodes[i], columns[c]->shape(i)));
      codedBytes += coded[c].back().size();
    }
  }
  Bytes values;
  for (auto _ : state)
  {
    for (std::size_t c = 0; c < columns.size(); ++c)
    {
      for (std::size_t i = 0; i < nodes; ++i)
      {
        values.resize(columns[c]->nodes[i].size());
        if (!candidate.decode(coded[c][i], columns[c]->shape(i), values))
        {
          state.SkipWithError("cannot decode what was encoded");
        }
        benchmark::DoNotOptimize(values.data());
      }
    }
  }
  const auto points = static_cast<double>(nodes * nodePoints);
  state.counters["bytes_per_point"] = static_cast<double>(codedBytes) / points;
  state.counters["points"] =
    benchmark::Counter(points, benchmark::Counter::kIsIterationInvariantRate);
}

void encodeColumns(
  benchmark::State& state, const Candidate& candidate, const std::vector<const Column*>& columns)
{
  const std::size_t nodes = columns[0]->nodes.size();
  for (auto _ : state)
  {
    for (const Column* column : columns)
    {
      for (std::size_t i = 0; i < nodes; ++i)
      {
        benchmark::DoNotOptimize(candidate.encode(column->nodes[i], column->shape(i)).data());
      }
    }
  }
  const auto points = static_cast<double>(nodes * nodePoints);
  state.counters["points"] =
    benchmark::Counter(points, benchmark::Counter::kIsIterationInvariantRate);
}

void registerAll(const std::vector<Column>& columns)
{
  const std::vector<Candidate> candidates{ chosenByStore(), packed(), planesZstd(1), planesZstd(3),
    planesLz4(), meshoptimizer(false), meshoptimizer(true), raw() };
  std::vector<const Column*> all;
  for (const Column& column : columns)
  {
    all.push_back(&column);
  }
  for (const Candidate& candidate : candidates)
  {
    const auto decode = [candidate](benchmark::State& state, std::vector<const Column*> chosen)
    { decodeColumns(state, candidate, chosen); };
    benchmark::RegisterBenchmark(("decode/all/" + candidate.name).c_str(), decode, all)
      ->Unit(benchmark::kMillisecond);
    for (const Column* column : all)
    {
      benchmark::RegisterBenchmark(("decode/" + column->name + "/" + candidate.name).c_str(),
        decode, std::vector<const Column*>{ column })
        ->Unit(benchmark::kMillisecond);
    }
  }
  benchmark::RegisterBenchmark("encode/all/store",
    [all](benchmark::State& state) { encodeColumns(state, chosenByStore(), all); })
    ->Unit(benchmark::kMillisecond);
}
} // namespace

int main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  Cloud cloud;
  if (argc > 1)
  {
    pointfront::Result<Cloud> read = readCloud(argv[1]);
    if (!read)
    {
      std::fprintf(stderr, "%s\n", read.error().what.c_str());
      return 1;
    }
    cloud = std::move(*read);
  }
  else
  {
    cloud = syntheticTerrain(2000000);
  }
  const std::vector<Column> columns = asNodes(cloud);
  registerAll(columns);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
