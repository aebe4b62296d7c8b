#pragma once

#include "StoreBuildTest.h"

#include "pointfront/Collection/CollectionWriter.h"
#include "pointfront/Query/QueryPlan.h"
#include "pointfront/Tiles/CollectionCloud.h"

#include <cstring>
#include <map>
#include <set>

namespace pointfront::test
{

using IdsAndPlaces = std::map<std::uint32_t, glm::dvec3>;

/// Collections of small tiles whose points have ids.
class CollectionTest : public StoreBuildTest
{
protected:
  void SetUp() override
  {
    StoreBuildTest::SetUp();
    options_.nodePoints = 64;
  }
  std::string at(const std::string& name) const { return (folder_ / name).string(); }
  std::string city() const { return at("city.pfcollection"); }

  /// 500 points of 16 m by 16 m, whose ids begin with `first`.
  TileRequest tile(const std::string& name, std::uint32_t first, double x, double y = 0.0)
  {
    const QuantisationGrid grid = millimetres();
    auto cloud = std::make_unique<CloudSource>("tile", idSchema(), grid);
    Random random(first + 1);
    for (std::uint32_t i = 0; i < 500; ++i)
    {
      const glm::dvec3 p{ x + 16.0 * random.uniform(), y + 16.0 * random.uniform(),
        random.uniform() };
      cloud->addPosition(grid.toWorld(grid.toGrid(p)));
      cloud->addValue(0, first + i);
      cloud->addValue(1, static_cast<std::uint16_t>(first + i));
      points_[first][first + i] = cloud->positions().back();
    }
    options_.outputPath = at(name);
    const auto report = buildStore(one(std::move(cloud)), options_);
    EXPECT_TRUE(report) << report.error().what;
    return { options_.outputPath };
  }
  /// A row of so many tiles: t0.pfront, t1.pfront ...
  std::vector<TileRequest> row(std::uint32_t count)
  {
    std::vector<TileRequest> tiles;
    for (std::uint32_t i = 0; i < count; ++i)
    {
      tiles.push_back(tile("t" + std::to_string(i) + ".pfront", 1000 * i, 16.0 * i));
    }
    return tiles;
  }
  IdsAndPlaces expected(const std::set<std::uint32_t>& firsts) const
  {
    IdsAndPlaces all;
    for (const std::uint32_t first : firsts)
    {
      const IdsAndPlaces& own = points_.at(first);
      all.insert(own.begin(), own.end());
    }
    return all;
  }
  CollectionReport created(const std::vector<TileRequest>& tiles)
  {
    return sound(createCollection(city(), tiles, {}));
  }
  static CollectionReport sound(const Result<CollectionReport>& report)
  {
    EXPECT_TRUE(report) << report.error().what;
    return report ? *report : CollectionReport();
  }
  std::shared_ptr<const CollectionCloud> opened() const
  {
    auto cloud = CollectionCloud::open(city());
    EXPECT_TRUE(cloud) << cloud.error().what;
    return cloud ? *cloud : nullptr;
  }

  static Result<IdsAndPlaces> query(const StoredCloud& cloud, const PointQuery& query = {})
  {
    IdsAndPlaces found;
    std::uint64_t behind = 0;
    const auto report = queryPoints(cloud, query, {},
      [&](QueryBatch& batch) -> Result<void>
      {
        for (std::size_t i = 0; i < batch.size(); ++i)
        {
          EXPECT_GE(batch.ids[i], behind);
          behind = batch.ids[i] + 1;
          std::uint32_t id = 0;
          std::memcpy(&id, batch.points.columns[0].data() + 4 * i, 4);
          EXPECT_TRUE(found.emplace(id, batch.points.positions[i]).second) << id << " twice";
        }
        return {};
      });
    return report ? Result<IdsAndPlaces>(found) : report.error();
  }
  static IdsAndPlaces points(const StoredCloud& cloud)
  {
    const Result<IdsAndPlaces> found = query(cloud);
    EXPECT_TRUE(found) << found.error().what;
    return found ? *found : IdsAndPlaces();
  }
  static std::size_t openTiles(const CollectionCloud& cloud)
  {
    std::size_t open = 0;
    for (std::size_t t = 0; t < cloud.record().tiles.size(); ++t)
    {
      open += cloud.tiles().opened(t) != nullptr ? 1 : 0;
    }
    return open;
  }

  std::map<std::uint32_t, IdsAndPlaces> points_; ///< by the first id of each tile
};

} // namespace pointfront::test
