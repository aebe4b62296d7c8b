// The error that a front reports, and how far points of the input lie from the nearest drawn one.

#include "FrontScene.h"
#include "StoreBuildTest.h"

#include "pointfront/Store/PointStore.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

namespace pointfront
{
namespace
{

using test::CloudSource;
using test::Random;

constexpr std::size_t cloudPoints = 60000;

GridPosition inMillimetres(double x, double y, double z)
{
  return { std::llround(1000.0 * x), std::llround(1000.0 * y), std::llround(1000.0 * z) };
}

std::unique_ptr<CloudSource> evenCloud()
{
  return test::hills(cloudPoints, 100000.0);
}

/// Flight strips that overlap: points close together along a scan line, lines further apart.
std::unique_ptr<CloudSource> aerialCloud()
{
  auto random = std::make_shared<Random>(5);
  return test::cloudOf(cloudPoints, test::millimetres(),
    [random](std::size_t i)
    {
      constexpr std::size_t perLine = 300;
      const std::size_t line = i / perLine;
      const double across = 40.0 * double(i % perLine) / perLine;
      const double x = across + 30.0 * double(line / 66) + 0.02 * random->uniform();
      const double y = 1.5 * double(line % 66) + 0.1 * random->uniform();
      const bool roof = std::fmod(x, 25.0) < 10.0 && std::fmod(y, 30.0) < 12.0;
      return inMillimetres(x, y, (roof ? 8.0 : 0.0) + 0.05 * random->uniform());
    });
}

/// Equal angles around a scanner above a floor, within walls: a thousand times as dense near it.
std::unique_ptr<CloudSource> scannerCloud()
{
  auto random = std::make_shared<Random>(6);
  return test::cloudOf(cloudPoints, test::millimetres(),
    [random](std::size_t)
    {
      const double turn = 6.283185307 * random->uniform();
      const double rise = 1.4 * random->uniform() - 1.2;
      const glm::dvec3 ray(
        std::cos(rise) * std::cos(turn), std::cos(rise) * std::sin(turn), std::sin(rise));
      double t = ray.z < 0.0 ? -1.7 / ray.z : 1e9;
      for (int axis = 0; axis < 2; ++axis)
      {
        t = std::min(t, 30.0 / std::max(1e-9, std::abs(ray[axis])));
      }
      return inMillimetres(t * ray.x, t * ray.y, t * ray.z + 1.7);
    });
}

/// Positions in millimetres of a cloud, each `copies` times.
std::unique_ptr<CloudSource> copied(const CloudSource& cloud, std::size_t copies)
{
  const std::vector<glm::dvec3>& from = cloud.positions();
  return test::cloudOf(copies * from.size(), test::millimetres(),
    [&](std::size_t i)
    {
      const glm::dvec3& p = from[i / copies];
      return inMillimetres(p.x, p.y, p.z);
    });
}

std::unique_ptr<CloudSource> doubledCloud()
{
  return copied(*test::hills(cloudPoints / 2, 100000.0), 2);
}

std::unique_ptr<CloudSource> tripledCloud()
{
  return copied(*aerialCloud(), 3);
}

/// Few places, with many points in each.
std::unique_ptr<CloudSource> heapedCloud()
{
  return copied(*test::hills(cloudPoints / 200, 100000.0), 200);
}

/// Hills with five places that have a thousand points each: more than a node takes.
std::unique_ptr<CloudSource> heapsOnHills()
{
  const std::unique_ptr<CloudSource> hills = test::hills(cloudPoints, 100000.0);
  const std::vector<glm::dvec3>& from = hills->positions();
  return test::cloudOf(from.size() + 5000, test::millimetres(),
    [&](std::size_t i)
    {
      const glm::dvec3& p = from[i < from.size() ? i : 97 * ((i - from.size()) / 1000)];
      return inMillimetres(p.x, p.y, p.z);
    });
}

/// Straight down on everything, a thousand pixels wide.
View fromAbove(const Bounds& bounds)
{
  const glm::dvec3 middle = bounds.centre();
  const glm::dvec3 half = 0.55 * bounds.size() + 1.0;
  const double reach = std::max(half.x, half.y);
  glm::dmat4 toClip(1.0);
  toClip[0][0] = toClip[1][1] = 1.0 / reach;
  toClip[2][2] = -1.0 / half.z;
  toClip[3] = glm::dvec4(-middle.x / reach, -middle.y / reach, middle.z / half.z, 1.0);
  return View::fromMatrix(toClip, 1000, 1000);
}

/// Distances to the nearest of some points.
class NearestOf
{
public:
  NearestOf(const std::vector<glm::dvec3>& points, double cell)
    : cell_(cell)
  {
    for (const glm::dvec3& p : points)
    {
      cells_[keyOf(cellOf(p))].push_back(p);
    }
  }
  double distance(const glm::dvec3& from) const
  {
    double best = std::numeric_limits<double>::infinity();
    for (std::int64_t ring = 0; best > (double(ring) - 1.0) * cell_ && ring < 200; ++ring)
    {
      lookAt(from, ring, best);
    }
    return best;
  }

private:
  using Cell = std::array<std::int64_t, 3>;
  Cell cellOf(const glm::dvec3& p) const
  {
    return { std::llround(p.x / cell_), std::llround(p.y / cell_), std::llround(p.z / cell_) };
  }
  static std::uint64_t keyOf(const Cell& c)
  {
    return (std::uint64_t(c[0] + (1 << 20)) << 42) ^ (std::uint64_t(c[1] + (1 << 20)) << 21) ^
      std::uint64_t(c[2] + (1 << 20));
  }
  void lookAt(const glm::dvec3& from, std::int64_t ring, double& best) const
  {
    const Cell at = cellOf(from);
    for (std::int64_t z = -ring; z <= ring; ++z)
    {
      for (std::int64_t y = -ring; y <= ring; ++y)
      {
        const bool inner = std::abs(z) < ring && std::abs(y) < ring;
        for (std::int64_t x = -ring; x <= ring; x += inner && ring > 0 ? 2 * ring : 1)
        {
          const auto found = cells_.find(keyOf({ at[0] + x, at[1] + y, at[2] + z }));
          for (std::size_t i = 0; found != cells_.end() && i < found->second.size(); ++i)
          {
            best = std::min(best, glm::length(found->second[i] - from));
          }
        }
      }
    }
  }

  double cell_;
  std::unordered_map<std::uint64_t, std::vector<glm::dvec3>> cells_;
};

const std::pair<const char*, std::unique_ptr<CloudSource> (*)()> clouds[] = { { "even", evenCloud },
  { "aerial", aerialCloud }, { "scanner", scannerCloud }, { "doubled", doubledCloud },
  { "tripled", tripledCloud }, { "heaped", heapedCloud }, { "heaps on hills", heapsOnHills } };

struct StoredForm
{
  Structure structure;
  Refinement refinement;
  std::string name;
};

class TrueGaps
  : public test::StoreBuildTest
  , public testing::WithParamInterface<StoredForm>
{
protected:
  void SetUp() override
  {
    StoreBuildTest::SetUp();
    options_.structure = GetParam().structure;
    options_.refinement = GetParam().refinement;
    options_.nodePoints = 500;
  }
  /// The points that a view shows of a store whose nodes are all there.
  std::vector<glm::dvec3> drawn(const PointStore& store, const View& view, double px)
  {
    test::ScriptedResidency residency;
    residency.otherwise = ResidencySnapshot::State::Resident;
    FrontLimits limits;
    limits.targetErrorPx = px;
    limits.movesPerFrame = 1u << 20;
    RenderFront front(store.hierarchy());
    const FrontDelta* delta = &front.update(view, residency, limits);
    for (int update = 0; !delta->complete && update < 200; ++update)
    {
      delta = &front.update(view, residency, limits);
    }
    EXPECT_TRUE(delta->complete);
    EXPECT_LE(delta->errorPx, 1.000001 * px);
    errorPx_ = delta->errorPx;
    std::vector<glm::dvec3> points;
    for (const DrawItem& item : delta->draw)
    {
      const auto node = store.read(item.node, {});
      for (std::uint32_t i = 0; i < item.pointCount; ++i)
      {
        points.push_back(
          store.description().grid.toWorld(node->origin + GridPosition(node->positions[i])));
      }
    }
    return points;
  }

  double errorPx_ = 0.0;
};

INSTANTIATE_TEST_SUITE_P(Ways, TrueGaps,
  testing::Values(StoredForm{ Structure::Octree, Refinement::Add, "OctreeOfPoints" },
    StoredForm{ Structure::KdTree, Refinement::Add, "KdTreeOfPoints" },
    StoredForm{ Structure::Octree, Refinement::Replace, "OctreeOfMeans" },
    StoredForm{ Structure::KdTree, Refinement::Replace, "KdTreeOfMeans" }),
  [](const auto& instance) { return instance.param.name; });

} // namespace

// A subset is thinned out as a whole node is, so its error is the distance that neighbours have on
// average; nowhere are there gaps of several of it. Means: each stands for a cell as large as its
// node's error, and all of the cell is nearer than that on a surface.
TEST_P(TrueGaps, AreNoLargerThanTheErrorSays)
{
  const bool means = GetParam().refinement == Refinement::Replace;
  for (const auto& [name, make] : clouds)
  {
    std::unique_ptr<CloudSource> cloud = make();
    const std::vector<glm::dvec3> all = cloud->positions();
    const auto store = build(std::move(cloud));
    const View view = fromAbove(store->description().bounds);
    for (const double px : { 2.0, 8.0, 16.0, 32.0, 64.0 })
    {
      const std::vector<glm::dvec3> points = drawn(*store, view, px);
      if (errorPx_ == 0.0)
      {
        EXPECT_EQ(points.size(), all.size());
        continue;
      }
      const NearestOf nearest(points, std::max(px, 8.0) / view.pixelsPerUnit);
      std::vector<double> gaps; // in errors
      for (std::size_t i = 0; i < all.size(); i += 3)
      {
        gaps.push_back(nearest.distance(all[i]) * view.pixelsPerUnit / errorPx_);
      }
      std::sort(gaps.begin(), gaps.end());
      const auto in = std::string(name) + " at " + std::to_string(px);
      EXPECT_LT(gaps[gaps.size() * 99 / 100], means ? 0.9 : 1.6) << in;
      // Near the scanner's floor one leaf is dense where another part of it is sparse.
      EXPECT_LT(gaps.back(), means ? 1.1 : px < 8.0 ? 7.0 : 3.0) << in;
    }
  }
}

// The stored spacing of an inner node's means is the edge of their cells.
TEST_P(TrueGaps, OfMeansAreTheirCells)
{
  if (GetParam().refinement == Refinement::Add)
  {
    return;
  }
  for (const auto& [name, make] : clouds)
  {
    const auto store = build(make());
    const Hierarchy& nodes = *store->hierarchy();
    for (NodeIndex n = 0; n < nodes.nodeCount(); ++n)
    {
      const Node node = nodes.node(n);
      if (node.leaf())
      {
        continue;
      }
      const double steps = node.spacing / store->description().grid.scale.x;
      const double octaves = std::log2(steps);
      EXPECT_NEAR(octaves, std::round(octaves), 1e-3) << name << ", node " << n;
      if (node.parent != noNode)
      {
        EXPECT_LE(2.0f * node.spacing, nodes.node(node.parent).spacing) << name << ", node " << n;
      }
    }
  }
}

} // namespace pointfront
