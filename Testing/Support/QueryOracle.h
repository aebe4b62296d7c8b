#pragma once

#include "RandomRounds.h"

#include "pointfront/Points/PointSource.h"
#include "pointfront/Query/BoxRegion.h"
#include "pointfront/Query/ConvexRegion.h"
#include "pointfront/Query/LineCorridor.h"
#include "pointfront/Query/PointsById.h"
#include "pointfront/Query/PolygonPrism.h"
#include "pointfront/Query/QueryPlan.h"
#include "pointfront/Query/SphereRegion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <string>
#include <utility>
#include <vector>

/// Queries against what they mean: a cloud of whole numbers, and conditions on it that integer
/// arithmetic answers for each point, without a tree and without the kernel's geometry.
namespace pointfront::test
{

using Steps = GridPosition;
using Flat = glm::vec<2, std::int64_t, glm::defaultp>;

/// A point as integers: `steps` on the grid of OracleCloud.
struct OraclePoint
{
  Steps steps{ 0 };
  std::uint8_t code = 0;
  std::uint16_t intensity = 0;
};

/// SplitMix64: the same numbers everywhere.
class OracleRandom
{
public:
  explicit OracleRandom(std::uint64_t seed)
    : state_(seed)
  {
  }
  std::int64_t upTo(std::int64_t most) // 0 to most
  {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return static_cast<std::int64_t>((z ^ (z >> 31)) % static_cast<std::uint64_t>(most + 1));
  }

private:
  std::uint64_t state_;
};

/// Points on a coarse lattice far from the origin, so that many lie on edges and corners of the
/// queries. Steps of 1/4 are exact in double. gps_time is the number of the point.
class OracleCloud final : public PointSource
{
public:
  static constexpr std::int64_t side = 400; ///< steps

  explicit OracleCloud(std::size_t count)
  {
    description_.path = "oracle";
    description_.pointCount = count;
    description_.grid = QuantisationGrid{ glm::dvec3(0.25), { 637000.0, 5850000.0, 100.0 } };
    description_.schema.add({ "intensity", ScalarType::UInt16, 1 });
    description_.schema.add({ "classification", ScalarType::UInt8, 1 });
    description_.schema.add({ "gps_time", ScalarType::Float64, 1 });
    OracleRandom random(7);
    for (std::size_t i = 0; i < count; ++i)
    {
      OraclePoint p;
      p.steps = { random.upTo(side), random.upTo(side), 0 };
      p.steps.z = (p.steps.x + p.steps.y) / 20 + random.upTo(30);
      p.code = static_cast<std::uint8_t>(p.steps.x < side / 4 ? 9 : 2 + random.upTo(4));
      p.intensity = static_cast<std::uint16_t>(p.steps.y * 7 + random.upTo(300));
      points_.push_back(p);
      description_.declaredBounds.add(world(p.steps));
    }
  }

  const std::vector<OraclePoint>& points() const { return points_; }
  glm::dvec3 world(const Steps& steps) const { return description_.grid->toWorld(steps); }

  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return 1; }
  std::uint64_t chunkPoints(std::uint64_t) const override { return points_.size(); }
  Result<void> read(std::uint64_t, PointBatch& batch) const override
  {
    batch.resize(points_.size(), description_.schema);
    for (std::size_t i = 0; i < points_.size(); ++i)
    {
      const auto number = static_cast<double>(i);
      batch.positions[i] = world(points_[i].steps);
      std::memcpy(batch.columns[0].data() + 2 * i, &points_[i].intensity, 2);
      std::memcpy(batch.columns[1].data() + i, &points_[i].code, 1);
      std::memcpy(batch.columns[2].data() + 8 * i, &number, 8);
    }
    return {};
  }

private:
  SourceDescription description_;
  std::vector<OraclePoint> points_;
};

/// The meaning of a query. `near` says that a point is too close to a boundary that is no integer.
struct OracleQuery
{
  PointQuery query;
  std::string text;
  std::function<bool(const OraclePoint&)> passes = [](const OraclePoint&) { return true; };
  std::function<bool(const OraclePoint&)> near = [](const OraclePoint&) { return false; };

  void also(const std::string& words, std::function<bool(const OraclePoint&)> condition)
  {
    text += words + "; ";
    passes = [before = passes, condition = std::move(condition)](const OraclePoint& p)
    { return before(p) && condition(p); };
  }
};

/// Even-odd, edges included, in whole numbers.
inline bool insideRings(const std::vector<std::vector<Flat>>& rings, const Flat& p)
{
  bool inside = false;
  for (const std::vector<Flat>& ring : rings)
  {
    for (std::size_t i = 0; i < ring.size(); ++i)
    {
      const Flat a = ring[i];
      const Flat b = ring[(i + 1) % ring.size()];
      const std::int64_t cross = (b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x);
      const bool within = p.x >= std::min(a.x, b.x) && p.x <= std::max(a.x, b.x) &&
        p.y >= std::min(a.y, b.y) && p.y <= std::max(a.y, b.y);
      if (cross == 0 && within)
      {
        return true;
      }
      if ((a.y <= p.y) != (b.y <= p.y))
      {
        inside = inside != ((cross > 0) == (b.y > a.y));
      }
    }
  }
  return inside;
}

/// Random queries of every kind, alone and together.
class OracleQueries
{
public:
  OracleQueries(const OracleCloud& cloud, std::uint64_t seed)
    : cloud_(cloud)
    , random_(seed)
  {
  }

  OracleQuery next()
  {
    OracleQuery query;
    const std::int64_t kind = number_++ % 6;
    kind == 0     ? addBox(query)
      : kind == 1 ? addPrism(query)
      : kind == 2 ? addSphere(query)
      : kind == 3 ? addConvex(query)
      : kind == 4 ? addCorridor(query)
                  : addIntensity(query);
    random_.upTo(2) == 0 ? addClasses(query) : void();
    random_.upTo(3) == 0 ? addIntensity(query) : void();
    random_.upTo(5) == 0 ? addBox(query) : void();
    return query;
  }

private:
  std::int64_t place() { return random_.upTo(OracleCloud::side + 40) - 20; }
  Flat flat() { return { place(), place() }; }
  glm::dvec2 worldOf(const Flat& p) const { return glm::dvec2(cloud_.world({ p.x, p.y, 0 })); }

  void addBox(OracleQuery& query)
  {
    Steps a{ place(), place(), random_.upTo(70) };
    Steps b{ place(), place(), random_.upTo(70) };
    const Steps low = glm::min(a, b);
    const Steps high = glm::max(a, b);
    query.query.regions.push_back(
      BoxRegion::make({ cloud_.world(low), cloud_.world(high) }).value());
    query.also("box",
      [low, high](const OraclePoint& p)
      { return glm::min(p.steps, low) == low && glm::max(p.steps, high) == high; });
  }

  void addPrism(OracleQuery& query)
  {
    std::vector<std::vector<std::vector<Flat>>> polygons(
      static_cast<std::size_t>(1 + random_.upTo(1)));
    std::vector<PlanarPolygon> world;
    for (auto& rings : polygons)
    {
      world.emplace_back();
      for (std::int64_t r = random_.upTo(2); r >= 0; --r)
      {
        rings.emplace_back();
        world.back().rings.emplace_back();
        for (std::int64_t v = 3 + random_.upTo(5); v > 0; --v)
        {
          rings.back().push_back(flat());
          world.back().rings.back().push_back(worldOf(rings.back().back()));
        }
        if (random_.upTo(1) == 0)
        {
          world.back().rings.back().push_back(world.back().rings.back().front());
        }
      }
    }
    const std::int64_t top = random_.upTo(70);
    const double height = cloud_.world({ 0, 0, top }).z;
    query.query.regions.push_back(
      PolygonPrism::make(world, { -PolygonPrism::unbounded, height }).value());
    query.also("prism",
      [polygons, top](const OraclePoint& p)
      {
        return p.steps.z <= top &&
          std::any_of(polygons.begin(), polygons.end(),
            [&p](const auto& rings) { return insideRings(rings, Flat(p.steps)); });
      });
  }

  void addSphere(OracleQuery& query)
  {
    const Steps centre{ place(), place(), random_.upTo(70) };
    const std::int64_t radius = random_.upTo(120);
    query.query.regions.push_back(
      SphereRegion::make(cloud_.world(centre), 0.25 * double(radius)).value());
    query.also("sphere",
      [centre, radius](const OraclePoint& p)
      {
        const Steps d = p.steps - centre;
        return d.x * d.x + d.y * d.y + d.z * d.z <= radius * radius;
      });
  }

  void addConvex(OracleQuery& query)
  {
    std::vector<glm::dvec4> planes;
    std::vector<std::pair<Steps, Steps>> sides; // normal and a point on the plane
    for (std::int64_t n = 1 + random_.upTo(4); n > 0; --n)
    {
      const Steps normal{ random_.upTo(8) - 4, random_.upTo(8) - 4, 1 + random_.upTo(3) };
      const Steps on{ place(), place(), random_.upTo(70) };
      sides.emplace_back(normal, on);
      // Products of world coordinates and these normals are whole numbers of quarters: exact.
      const glm::dvec3 p = cloud_.world(on);
      planes.emplace_back(normal.x, normal.y, normal.z,
        -(double(normal.x) * p.x + double(normal.y) * p.y + double(normal.z) * p.z));
    }
    query.query.regions.push_back(ConvexRegion::make(planes).value());
    query.also("convex",
      [sides](const OraclePoint& p)
      {
        return std::all_of(sides.begin(), sides.end(),
          [&p](const std::pair<Steps, Steps>& side)
          {
            const Steps d = p.steps - side.second;
            return side.first.x * d.x + side.first.y * d.y + side.first.z * d.z >= 0;
          });
      });
  }

  /// Squared distance of a segment, in steps, in long double.
  static long double squaredDistance(const Flat& a, const Flat& b, const Flat& p)
  {
    const Flat ab = b - a;
    const Flat ap = p - a;
    const std::int64_t length = ab.x * ab.x + ab.y * ab.y;
    const std::int64_t along = ap.x * ab.x + ap.y * ab.y;
    if (along <= 0 || length == 0)
    {
      return static_cast<long double>(ap.x * ap.x + ap.y * ap.y);
    }
    if (along >= length)
    {
      const Flat bp = p - b;
      return static_cast<long double>(bp.x * bp.x + bp.y * bp.y);
    }
    const std::int64_t cross = ab.x * ap.y - ab.y * ap.x;
    return static_cast<long double>(cross) * cross / length;
  }

  void addCorridor(OracleQuery& query)
  {
    std::vector<Flat> line;
    PlanarLine world;
    for (std::int64_t v = 1 + random_.upTo(3); v > 0; --v)
    {
      line.push_back(flat());
      world.push_back(worldOf(line.back()));
    }
    const std::int64_t distance = random_.upTo(80);
    query.query.regions.push_back(LineCorridor::make({ world }, 0.25 * double(distance)).value());
    const auto excess = [line, distance](const OraclePoint& p)
    {
      long double least = squaredDistance(line[0], line[0], Flat(p.steps));
      for (std::size_t i = 0; i + 1 < line.size(); ++i)
      {
        least = std::min(least, squaredDistance(line[i], line[i + 1], Flat(p.steps)));
      }
      return least - static_cast<long double>(distance * distance);
    };
    query.also("corridor", [excess](const OraclePoint& p) { return excess(p) <= 0; });
    query.near = [excess](const OraclePoint& p) { return std::abs(excess(p)) < 1e-6L; };
  }

  void addIntensity(OracleQuery& query)
  {
    const std::int64_t low = random_.upTo(3000);
    const std::int64_t high = low + random_.upTo(800);
    const std::string text = (query.query.where.empty() ? "" : query.query.where.text + " and ") +
      "intensity in [" + std::to_string(low) + ", " + std::to_string(high) + ")";
    query.query.where = FilterExpression::parse(text).value();
    query.also(
      text, [low, high](const OraclePoint& p) { return p.intensity >= low && p.intensity < high; });
  }

  void addClasses(OracleQuery& query)
  {
    const auto one = static_cast<std::uint8_t>(2 + random_.upTo(4));
    query.query.classes = { one, 9 };
    query.also("class " + std::to_string(one),
      [one](const OraclePoint& p) { return p.code == one || p.code == 9; });
  }

  const OracleCloud& cloud_;
  OracleRandom random_;
  std::int64_t number_ = 0;
};

/// Everything that a query hands over.
struct QueryAnswer
{
  std::vector<NodeIndex> nodes; ///< node of each batch
  std::vector<std::uint64_t> ids;
  std::vector<glm::dvec3> positions;
  std::vector<std::vector<std::byte>> columns;

  Result<void> add(const QueryBatch& batch)
  {
    EXPECT_EQ(batch.points.positions.size(), batch.ids.size());
    nodes.push_back(batch.node);
    ids.insert(ids.end(), batch.ids.begin(), batch.ids.end());
    positions.insert(positions.end(), batch.points.positions.begin(), batch.points.positions.end());
    columns.resize(batch.points.columns.size());
    for (std::size_t c = 0; c < columns.size(); ++c)
    {
      const std::vector<std::byte>& more = batch.points.columns[c];
      columns[c].insert(columns[c].end(), more.begin(), more.end());
    }
    return {};
  }
  QueryConsumer consumer()
  {
    return [this](QueryBatch& batch) { return add(batch); };
  }
  template <typename T>
  T value(std::size_t column, std::size_t point) const
  {
    T value;
    std::memcpy(&value, columns.at(column).data() + point * sizeof(T), sizeof(T));
    return value;
  }
};

/// The answer holds each point that the oracle wants once and no other, as it was put in. It asks
/// for gps_time, intensity and classification.
inline void expectOracle(
  const StoredCloud& store, const OracleCloud& cloud, const OracleQuery& asked)
{
  QueryAnswer answer;
  const auto report = queryPoints(store, asked.query, {}, answer.consumer());
  ASSERT_TRUE(report) << report.error().what;
  EXPECT_EQ(report->pointsChosen, answer.ids.size());
  answer.columns.resize(3);
  const AttributeSchema& schema = store.description().schema;
  std::vector<std::string> names{ "gps_time", "intensity", "classification" };
  std::sort(names.begin(), names.end(),
    [&schema](const std::string& a, const std::string& b)
    { return *schema.find(a) < *schema.find(b); });
  const auto columnOf = [&names](const char* name)
  { return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin()); };
  std::vector<bool> found(cloud.points().size(), false);
  for (std::size_t i = 0; i < answer.ids.size(); ++i)
  {
    const auto number = static_cast<std::size_t>(answer.value<double>(columnOf("gps_time"), i));
    ASSERT_LT(number, found.size());
    EXPECT_FALSE(found[number]) << "twice";
    found[number] = true;
    const OraclePoint& point = cloud.points()[number];
    EXPECT_EQ(answer.positions[i], cloud.world(point.steps));
    EXPECT_EQ(answer.value<std::uint16_t>(columnOf("intensity"), i), point.intensity);
    EXPECT_EQ(answer.value<std::uint8_t>(columnOf("classification"), i), point.code);
  }
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const OraclePoint& point = cloud.points()[i];
    ASSERT_TRUE(asked.near(point) || found[i] == asked.passes(point))
      << "point " << i << (found[i] ? " is not in " : " is missing from ") << asked.text;
  }
}

/// `count` random queries (randomRounds()), and the same points again by their ids.
inline void expectOracle(const StoredCloud& store, const OracleCloud& cloud, int count)
{
  OracleQueries queries(cloud, 42);
  for (int i = 0; i < randomRounds(count) && !testing::Test::HasFatalFailure(); ++i)
  {
    SCOPED_TRACE("query " + std::to_string(i));
    OracleQuery asked = queries.next();
    asked.query.attributes = { "gps_time", "intensity", "classification" };
    expectOracle(store, cloud, asked);
    if (i % 10 == 0)
    {
      QueryAnswer answer;
      QueryAnswer again;
      ASSERT_TRUE(queryPoints(store, asked.query, {}, answer.consumer()));
      std::sort(answer.ids.begin(), answer.ids.end());
      ASSERT_TRUE(pointsById(store, answer.ids, asked.query.attributes, {}, again.consumer()));
      EXPECT_TRUE(again.ids == answer.ids);
      EXPECT_TRUE(again.columns == answer.columns);
      EXPECT_TRUE(again.positions == answer.positions);
    }
  }
}

} // namespace pointfront::test
