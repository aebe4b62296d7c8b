// Neighbourhoods out of core: the same as by brute force, however the cloud is cut.

#include "TestBuildClouds.h"

#include "pointfront/Neighbourhood/KdIndex.h"
#include "pointfront/Neighbourhood/NearestNeighbours.h"
#include "pointfront/Neighbourhood/PointColumn.h"
#include "pointfront/Neighbourhood/TileLayout.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace
{
using namespace pointfront;
using pointfront::test::CloudSource;
using pointfront::test::Random;

using Positions = std::vector<glm::dvec3>;

/// Tells a neighbourhood from any other: number of neighbours, distance of the last, and the sum of
/// the offsets, whose terms are in a fixed order.
struct Signature
{
  double count = 0.0;
  double last = 0.0;
  glm::dvec3 offsets{ 0.0 };
  bool operator==(const Signature& o) const
  {
    return count == o.count && last == o.last && offsets == o.offsets;
  }
};

class SignatureFeature final : public NeighbourhoodFeature
{
public:
  std::size_t bytes() const override { return sizeof(Signature); }
  void compute(
    const glm::dvec3& position, const std::vector<NearPoint>& near, std::byte* value) const override
  {
    Signature signature;
    for (const NearPoint& neighbour : near)
    {
      signature.count += neighbour.count;
      signature.last = neighbour.squaredDistance;
      signature.offsets += double(neighbour.count) * (neighbour.position - position);
    }
    std::memcpy(value, &signature, sizeof signature);
  }
};

AttributeSchema classSchema()
{
  AttributeSchema schema;
  schema.add({ "classification", ScalarType::UInt8, 1 });
  return schema;
}

/// In two sources, so that numbers run on over their border.
PointSources cloudOf(const Positions& positions, const std::vector<std::uint8_t>& classes)
{
  PointSources sources;
  for (int s = 0; s < 2; ++s)
  {
    auto source = std::make_unique<CloudSource>("cloud", classSchema(), std::nullopt, 97);
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      if ((i < positions.size() / 3) == (s == 0))
      {
        source->addPosition(positions[i]);
        source->addValue(0, classes.empty() ? std::uint8_t(1) : classes[i]);
      }
    }
    sources.push_back(std::move(source));
  }
  return sources;
}

std::vector<Signature> computed(const Positions& positions, NeighbourhoodOptions options,
  std::uint64_t tilePoints, const std::vector<std::uint8_t>& classes = {}, std::uint64_t memory = 0,
  unsigned threads = 2)
{
  options.tilePoints = tilePoints;
  const PointSources sources = cloudOf(positions, classes);
  const InputOrder order(sources);
  PassResources resources;
  resources.threads = threads;
  resources.memoryBytes = memory;
  resources.temporaryFolder = testing::TempDir();
  const int axes = static_cast<int>(options.axes);
  const Result<std::unique_ptr<PointColumn>> column = computeFromNeighbours(
    sources, order, options,
    [axes](const PositionSet& set) { return std::make_unique<KdIndex>(set, axes); },
    SignatureFeature(), resources);
  EXPECT_TRUE(column) << (column ? "" : column.error().what);
  std::vector<Signature> values(positions.size());
  if (column)
  {
    EXPECT_TRUE((*column)->read(0, values.size(), reinterpret_cast<std::byte*>(values.data())));
  }
  return values;
}

/// One by one, with nothing but a partial sort.
std::vector<Signature> byBruteForce(const Positions& positions, const NeighbourhoodOptions& options,
  const std::vector<std::uint8_t>& classes = {})
{
  std::vector<Signature> values(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    const std::uint8_t own = classes.empty() ? std::uint8_t(1) : classes[i];
    if (!hasPlace(positions[i]) || !options.participants.queries[own])
    {
      continue;
    }
    std::vector<NearPoint> all;
    for (std::size_t j = 0; j < positions.size(); ++j)
    {
      const std::uint8_t other = classes.empty() ? std::uint8_t(1) : classes[j];
      if (hasPlace(positions[j]) && options.participants.references[other])
      {
        const glm::dvec3 d = positions[j] - positions[i];
        const double squared =
          options.axes > 2 ? d.x * d.x + d.y * d.y + d.z * d.z : d.x * d.x + d.y * d.y;
        if (options.neighbours > 0 || squared <= options.radius * options.radius)
        {
          all.push_back({ positions[j], squared, 1 });
        }
      }
    }
    const std::size_t wanted = options.neighbours > 0 ? options.neighbours : all.size();
    const auto last = all.begin() + std::ptrdiff_t(std::min(wanted, all.size()));
    std::partial_sort(all.begin(), last, all.end(),
      [](const NearPoint& a, const NearPoint& b)
      {
        return a.squaredDistance != b.squaredDistance ? a.squaredDistance < b.squaredDistance
                                                      : positionLess(a.position, b.position);
      });
    all.erase(last, all.end());
    // Points at one place are one neighbour that counts several times.
    std::vector<NearPoint> places;
    for (const NearPoint& point : all)
    {
      const bool same = !places.empty() && places.back().position == point.position;
      same ? ++places.back().count : (places.push_back(point), 0u);
    }
    SignatureFeature().compute(positions[i], places, reinterpret_cast<std::byte*>(&values[i]));
  }
  return values;
}

void expectAsByBruteForce(const Positions& positions, const NeighbourhoodOptions& options,
  const std::vector<std::uint8_t>& classes = {})
{
  const std::vector<Signature> expected = byBruteForce(positions, options, classes);
  for (const std::size_t tiles : { 1, 4, 64 })
  {
    const std::vector<Signature> values =
      computed(positions, options, positions.size() / tiles + 1, classes);
    std::size_t different = 0;
    for (std::size_t i = 0; i < expected.size(); ++i)
    {
      different += values[i] == expected[i] ? 0 : 1;
    }
    EXPECT_EQ(different, 0u) << "of " << positions.size() << " points, in " << tiles << " tiles";
  }
}

NeighbourhoodOptions nearest(std::uint32_t count)
{
  NeighbourhoodOptions options;
  options.neighbours = count;
  return options;
}

Positions hilly(std::size_t count, const glm::dvec3& origin, double side = 100.0)
{
  Random random(7);
  Positions positions;
  for (std::size_t i = 0; i < count; ++i)
  {
    const double x = side * random.uniform();
    const double y = side * random.uniform();
    positions.push_back(origin + glm::dvec3(x, y, 0.05 * side * std::sin(9.0 * x / side)));
  }
  return positions;
}

TEST(Neighbourhood, NearestAreThoseOfBruteForceForAnyTiles)
{
  expectAsByBruteForce(hilly(1300, glm::dvec3(0.0)), nearest(16));
  expectAsByBruteForce(hilly(1300, glm::dvec3(-50.0, -50.0, 0.0)), nearest(1));
}

TEST(Neighbourhood, FarFromTheOriginToo)
{
  Positions far = hilly(1300, glm::dvec3(1e7, -1e7, 500.0), 20.0);
  for (glm::dvec3& p : far)
  {
    p = glm::dvec3(std::round(p.x * 1e3) / 1e3, std::round(p.y * 1e3) / 1e3, p.z);
  }
  expectAsByBruteForce(far, nearest(16));
}

TEST(Neighbourhood, TiesAreBrokenByCoordinates)
{
  Positions grid;
  for (int i = 0; i < 11 * 11 * 11; ++i)
  {
    grid.emplace_back(i % 11, i / 11 % 11, i / 121);
  }
  expectAsByBruteForce(grid, nearest(5));
  expectAsByBruteForce(grid, nearest(16));
}

TEST(Neighbourhood, OutliersAndClustersOfAnyDensity)
{
  Random random(3);
  Positions positions = hilly(700, glm::dvec3(0.0), 1.0);
  const Positions dense = hilly(700, glm::dvec3(900.0, 900.0, 10.0), 0.001);
  positions.insert(positions.end(), dense.begin(), dense.end());
  for (int i = 0; i < 40; ++i)
  {
    positions.emplace_back(
      2000.0 * random.uniform(), 2000.0 * random.uniform(), 3000.0 * random.uniform());
  }
  expectAsByBruteForce(positions, nearest(16));
}

TEST(Neighbourhood, DuplicatesCountOnceEach)
{
  Positions positions = hilly(400, glm::dvec3(0.0));
  for (int i = 0; i < 2000; ++i)
  {
    positions.push_back(positions[static_cast<std::size_t>(i) % 70]);
  }
  expectAsByBruteForce(positions, nearest(16));
}

TEST(Neighbourhood, ManyEqualPointsTakeNoLongerThanOthers)
{
  Positions positions = hilly(1000, glm::dvec3(0.0));
  positions.insert(positions.end(), 300000, glm::dvec3(5.0, 5.0, 5.0));
  const std::vector<Signature> values = computed(positions, nearest(16), 1 << 17);
  EXPECT_EQ(values.back().count, 16.0);
  EXPECT_EQ(values.back().last, 0.0);
}

TEST(Neighbourhood, FewerPointsThanWanted)
{
  expectAsByBruteForce({}, nearest(16));
  expectAsByBruteForce({ { 1.0, 2.0, 3.0 } }, nearest(16));
  expectAsByBruteForce(hilly(11, glm::dvec3(0.0)), nearest(16));
}

TEST(Neighbourhood, PointsWithoutAPlaceHaveNoNeighbours)
{
  Positions positions = hilly(500, glm::dvec3(0.0));
  positions[17].x = std::numeric_limits<double>::quiet_NaN();
  positions[300].z = std::numeric_limits<double>::infinity();
  positions[301].y = -1e300;
  expectAsByBruteForce(positions, nearest(8));
}

TEST(Neighbourhood, ARadiusTakesAllWithin)
{
  NeighbourhoodOptions options = nearest(0);
  options.radius = 6.0;
  expectAsByBruteForce(hilly(2000, glm::dvec3(0.0)), options);
}

TEST(Neighbourhood, OnlyReferencesAreNeighbours)
{
  const Positions positions = hilly(3000, glm::dvec3(0.0));
  std::vector<std::uint8_t> classes;
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    // References at one end only: most points find none near.
    classes.push_back(positions[i].x < 5.0 ? std::uint8_t(2) : std::uint8_t(i % 2 == 0 ? 6 : 7));
  }
  NeighbourhoodOptions options = nearest(7);
  options.axes = 2;
  options.participants.references = ClassSet().set(2);
  options.participants.queries = ClassSet().set(2).set(6);
  expectAsByBruteForce(positions, options, classes);
}

TEST(Neighbourhood, SpilledOrNotIsTheSame)
{
  const Positions positions = hilly(20000, glm::dvec3(0.0));
  const std::vector<Signature> roomy = computed(positions, nearest(16), 1000);
  const std::vector<Signature> tight = computed(positions, nearest(16), 1000, {}, 700 << 10, 1);
  EXPECT_TRUE(roomy == tight);
}

TEST(Neighbourhood, TooLittleMemoryIsAnError)
{
  const PointSources sources = cloudOf(hilly(20000, glm::dvec3(0.0)), {});
  const InputOrder order(sources);
  PassResources resources;
  resources.memoryBytes = 64 << 10;
  resources.temporaryFolder = testing::TempDir();
  const auto column = computeFromNeighbours(
    sources, order, nearest(16),
    [](const PositionSet& set) { return std::make_unique<KdIndex>(set, 3); }, SignatureFeature(),
    resources);
  ASSERT_FALSE(column);
  EXPECT_EQ(column.error().kind, Error::Kind::NoMemory);
}

TEST(Neighbourhood, CancellingEndsIt)
{
  const PointSources sources = cloudOf(hilly(20000, glm::dvec3(0.0)), {});
  const InputOrder order(sources);
  PassResources resources;
  resources.temporaryFolder = testing::TempDir();
  resources.progress = [](const Progress&) { return false; };
  const auto column = computeFromNeighbours(
    sources, order, nearest(16),
    [](const PositionSet& set) { return std::make_unique<KdIndex>(set, 3); }, SignatureFeature(),
    resources);
  ASSERT_FALSE(column);
  EXPECT_EQ(column.error().kind, Error::Kind::Cancelled);
}

TEST(CellHistogram, TheResultDoesNotDependOnHowPointsAreSpread)
{
  const Positions positions = hilly(5000, glm::dvec3(-30.0, 10.0, 0.0));
  CellHistogram whole(-16, 3, 200);
  CellHistogram first(-16, 3, 200);
  CellHistogram second(-16, 3, 200);
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    whole.add(positions[i]);
    (i % 7 == 0 ? first : second).add(positions[positions.size() - 1 - i]);
  }
  first.add(second);
  EXPECT_EQ(first.edgeLog2(), whole.edgeLog2());
  EXPECT_EQ(first.points(), 5000u);
  const std::vector<PopulatedCell> a = first.cells();
  const std::vector<PopulatedCell> b = whole.cells();
  ASSERT_EQ(a.size(), b.size());
  EXPECT_LE(a.size(), 200u);
  EXPECT_GT(a.size(), 25u);
  for (std::size_t i = 0; i < a.size(); ++i)
  {
    EXPECT_EQ(a[i].index, b[i].index);
    EXPECT_EQ(a[i].points, b[i].points);
  }
}

TEST(TileLayout, TilesPartSpaceAndGatherTheirHalo)
{
  const Positions positions = hilly(5000, glm::dvec3(0.0));
  CellHistogram histogram(-4, 3, 4096);
  for (const glm::dvec3& p : positions)
  {
    histogram.add(p);
  }
  TilingOptions options;
  options.tilePoints = 500;
  options.halo = 3.0;
  const TileLayout layout(histogram, options);
  ASSERT_GE(layout.tiles().size(), 10u);
  std::vector<std::uint64_t> own(layout.tiles().size());
  std::vector<std::uint64_t> gathered(layout.tiles().size());
  for (const glm::dvec3& p : positions)
  {
    const std::size_t tile = layout.tileOf(p);
    ++own[tile];
    EXPECT_TRUE(layout.tiles()[tile].own.contains(p));
    bool alone = true;
    layout.forEachGathering(p, p,
      [&](std::size_t t)
      {
        ++gathered[t];
        alone = alone && t == tile;
        EXPECT_TRUE(layout.tiles()[t].gathered.contains(p));
      });
    EXPECT_TRUE(alone || !layout.isInner(p, tile));
  }
  for (std::size_t t = 0; t < own.size(); ++t)
  {
    EXPECT_EQ(own[t], layout.tiles()[t].points);
    EXPECT_LE(own[t], 500u);
    EXPECT_GT(own[t], 100u);
    EXPECT_LE(gathered[t], layout.tiles()[t].mostGathered);
    EXPECT_GT(gathered[t], own[t]);
  }
}

TEST(PointColumn, AttributesAreAddedOrReplacedInInputOrder)
{
  const Positions positions = hilly(1000, glm::dvec3(0.0));
  PointSources sources = cloudOf(positions, {});
  const InputOrder order(sources);
  ASSERT_EQ(order.points(), 1000u);
  PassResources resources;
  resources.temporaryFolder = testing::TempDir();
  auto column = PointColumn::create(resources, 1000, 3);
  ASSERT_TRUE(column);
  std::vector<std::uint64_t> numbers;
  std::vector<std::byte> values;
  for (unsigned i = 0; i < 1000; i += i % 3 == 0 ? 1 : 2) // some stay zero
  {
    numbers.push_back(i);
    values.insert(values.end(), { std::byte(i % 251), std::byte(7), std::byte(i % 13) });
  }
  ASSERT_TRUE((*column)->write(numbers, values));
  sources = withAttributes(std::move(sources),
    { { "classification", ScalarType::UInt8, 1 }, { "pair", ScalarType::UInt8, 2 } },
    valuesOf(std::move(*column), order));
  unsigned i = 0;
  for (const auto& source : sources)
  {
    const AttributeSchema& schema = source->description().schema;
    ASSERT_EQ(schema.size(), 2u);
    EXPECT_EQ(schema[1].name, "pair");
    PointBatch batch;
    for (std::uint64_t chunk = 0; chunk < source->chunkCount(); ++chunk)
    {
      ASSERT_TRUE(source->read(chunk, batch));
      for (std::size_t p = 0; p < batch.size(); ++p, ++i)
      {
        const bool written = std::binary_search(numbers.begin(), numbers.end(), i);
        EXPECT_EQ(batch.positions[p], positions[i]);
        EXPECT_EQ(batch.columns[0][p], written ? std::byte(i % 251) : std::byte(0));
        EXPECT_EQ(batch.columns[1][2 * p + 1], written ? std::byte(i % 13) : std::byte(0));
      }
    }
  }
  EXPECT_EQ(i, 1000u);
}
} // namespace
