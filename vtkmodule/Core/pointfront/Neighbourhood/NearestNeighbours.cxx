// Longer than 450 lines: both rounds of a search are of one class and its state.
#include "pointfront/Neighbourhood/NearestNeighbours.h"

#include "pointfront/Base/Infinity.h"
#include "pointfront/Neighbourhood/NeighbourCluster.h"
#include "pointfront/Neighbourhood/TileSearch.h"
#include "pointfront/Points/KnownRegion.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <mutex>

namespace pointfront
{
namespace
{
// Shares of the whole, for the progress fraction.
constexpr double readShare = 0.1; // twice
constexpr double searchShare = 0.8;

/// Memory that a point of a tile takes while it is searched: for itself, its place and the tree
/// over it, its order, its value on the way to the column.
constexpr std::uint64_t tilePointBytes = sizeof(TilePoint) + 2 * sizeof(glm::dvec3) + 64;

/// Points in a row along the curve that share what an index gives, and, of those, the ones that
/// share a choice from it. Longer ones have more places to choose from for each point.
constexpr std::size_t longestGroup = 96;
constexpr std::size_t longestRun = 16;

struct Ball
{
  glm::dvec3 middle{ 0.0 };
  double reach = 0.0;
};

/// The order in which a feature sees neighbours.
bool nearer(const NearPoint& a, const NearPoint& b)
{
  return a.squaredDistance != b.squaredDistance ? a.squaredDistance < b.squaredDistance
                                                : positionLess(a.position, b.position);
}

/// One computation over all tiles.
class Search
{
public:
  Search(const PointTiles& tiles, const NeighbourhoodOptions& options, const IndexMaker& makeIndex,
    const NeighbourhoodFeature& feature, PointColumn& column, WorkCrew& crew, KnownRegion* known)
    : tiles_(tiles)
    , options_(options)
    , makeIndex_(makeIndex)
    , feature_(feature)
    , column_(column)
    , crew_(crew)
    , known_(known)
  {
  }

  /// Both rounds; `mostUnfinished` points wait for the second one at a time.
  Result<void> run(std::size_t mostUnfinished);

private:
  Result<void> searchTile(std::size_t tile);
  struct TileWork;
  void searchRun(
    TileWork& work, std::size_t begin, std::size_t end, NeighbourCluster& cluster) const;
  bool compute(TileWork& work, std::uint32_t point, const NeighbourList& list) const;
  double squaredReach(const NeighbourList& list, const glm::dvec3& p) const;
  double squaredReach(const std::vector<NearPoint>& found) const;
  void note(const glm::dvec3& p, double squaredReach) const;
  Result<void> store(const std::vector<TilePoint>& points, const std::vector<bool>& finished,
    const std::vector<std::byte>& values) const;
  Result<void> finishUnfinished();
  Result<void> searchAgain(std::size_t tile, std::vector<std::vector<NearPoint>>& found);
  void merge(std::vector<NearPoint>& found, const std::vector<NearPoint>& more) const;

  const PointTiles& tiles_;
  const NeighbourhoodOptions& options_;
  const IndexMaker& makeIndex_;
  const NeighbourhoodFeature& feature_;
  PointColumn& column_;
  WorkCrew& crew_;
  KnownRegion* known_; ///< null: the sources are the whole cloud
  std::atomic<std::size_t> nextTile_{ 0 };
  std::mutex mutex_; // guards what follows
  std::vector<UnfinishedPoint> unfinished_;
};

Result<void> Search::run(std::size_t mostUnfinished)
{
  while (nextTile_ < tiles_.count())
  {
    const auto work = [&]() -> Result<void>
    {
      while (!crew_.stopped())
      {
        {
          const std::lock_guard<std::mutex> lock(mutex_);
          if (unfinished_.size() >= mostUnfinished)
          {
            return {};
          }
        }
        const std::size_t tile = nextTile_++;
        if (tile >= tiles_.count())
        {
          return {};
        }
        if (Result<void> done = searchTile(tile); !done)
        {
          return done;
        }
      }
      return {};
    };
    Result<void> done = crew_.run(work);
    done = done ? finishUnfinished() : done;
    if (!done)
    {
      return done;
    }
  }
  return {};
}

/// The objects that search one tile.
struct Search::TileWork
{
  TileWork(GatheredPoints gatheredPoints, const Bounds& gatheredBox, std::size_t valueBytes)
    : points(std::move(gatheredPoints.points))
    , box(gatheredBox)
    , values(gatheredPoints.own * valueBytes)
    , finished(gatheredPoints.own)
  {
  }
  std::vector<TilePoint> points; ///< own ones come first
  Bounds box; ///< that they were gathered from
  PlaceOrder queries;
  PositionSet references;
  std::vector<std::byte> values; ///< value of points[i]
  std::vector<bool> finished; ///< points[i]
  std::vector<UnfinishedPoint> unfinished;
  std::vector<std::uint32_t> places; ///< near one point
  std::vector<NearPoint> near;

  /// Around queries [begin, end); the reach is over the first `axes`.
  Ball ballAround(std::size_t begin, std::size_t end, unsigned axes) const;
};

Ball Search::TileWork::ballAround(std::size_t begin, std::size_t end, unsigned axes) const
{
  Bounds bounds;
  for (std::size_t query = begin; query < end; ++query)
  {
    bounds.add(points[queries.points[query]].position);
  }
  const glm::dvec3 middle = bounds.centre();
  double reach = 0.0;
  for (std::size_t query = begin; query < end; ++query)
  {
    const glm::dvec3 out = points[queries.points[query]].position - middle;
    reach = std::max(reach, out.x * out.x + out.y * out.y + (axes > 2 ? out.z * out.z : 0.0));
  }
  return { middle, std::sqrt(reach) };
}

Result<void> Search::searchTile(std::size_t tile)
{
  Result<GatheredPoints> gathered = tiles_.gathered(tile);
  if (!gathered)
  {
    return gathered.error();
  }
  const std::size_t own = gathered->own;
  TileWork work(std::move(*gathered), tiles_.layout().tiles()[tile].gathered, feature_.bytes());
  const PlaceOrder order = placeOrder(work.points);
  const Participants& participants = tiles_.participants();
  work.queries = queriesOf(order, work.points, own, participants.queries, known_);
  if (work.queries.points.empty())
  {
    return {}; // nobody asks for values here
  }
  collectReferences(work.points, order, participants.references, options_.axes,
    options_.neighbours > 0 ? options_.neighbours : ~0u, work.references);
  const std::unique_ptr<NeighbourIndex> index = makeIndex_(work.references);
  NeighbourCluster cluster(
    work.references, *index, { options_.neighbours, options_.radius, options_.axes });
  for (std::size_t begin = 0; begin < work.queries.points.size();)
  {
    if (crew_.stopped())
    {
      return {};
    }
    const std::size_t end =
      runEnd(work.queries.keys, begin, work.queries.keys.size(), longestGroup);
    const Ball group = work.ballAround(begin, end, options_.axes);
    cluster.gather(group.middle, group.reach);
    for (std::size_t run = begin; run < end;)
    {
      const std::size_t next = runEnd(work.queries.keys, run, end, longestRun);
      const Ball ball = work.ballAround(run, next, options_.axes);
      cluster.focus(ball.middle, ball.reach);
      searchRun(work, run, next, cluster);
      run = next;
    }
    begin = end;
  }
  crew_.advance(work.queries.points.size() - work.unfinished.size());
  if (Result<void> done = store(work.points, work.finished, work.values); !done)
  {
    return done;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  unfinished_.insert(unfinished_.end(), work.unfinished.begin(), work.unfinished.end());
  return {};
}

void Search::searchRun(
  TileWork& work, std::size_t begin, std::size_t end, NeighbourCluster& cluster) const
{
  NeighbourList list(options_.neighbours);
  const std::size_t bytes = feature_.bytes();
  const bool orderFree = feature_.orderFree() && options_.axes > 2;
  double reach = 0.0;
  const std::uint32_t* before = nullptr; // computed last
  for (std::size_t query = begin; query < end; ++query)
  {
    const std::uint32_t& i = work.queries.points[query];
    const glm::dvec3& position = work.points[i].position;
    if (before != nullptr && work.points[*before].position == position) // a duplicate
    {
      const std::byte* const value = work.values.data() + *before * bytes;
      std::memcpy(work.values.data() + i * bytes, value, bytes);
      feature_.copied(value);
      work.finished[i] = true;
      continue;
    }
    before = nullptr;
    if (orderFree && cluster.searchUnordered(position, work.places, reach) &&
      reach < squaredClearance(work.box, position))
    {
      note(position, reach);
      collectNear(work.references, work.places, position, work.near);
      feature_.compute(position, work.near, work.values.data() + i * bytes);
      work.finished[i] = true;
      before = &i;
      continue;
    }
    cluster.search(position, list);
    if (compute(work, i, list))
    {
      work.finished[i] = true;
      before = &i;
    }
    else
    {
      work.unfinished.push_back({ work.points[i], squaredReach(list, position) });
    }
  }
}

/// The value of a point from its list; false if neighbours may lie outside of what was gathered.
bool Search::compute(TileWork& work, std::uint32_t point, const NeighbourList& list) const
{
  const glm::dvec3& p = work.points[point].position;
  const double clearance = squaredClearance(work.box, p);
  if (options_.neighbours > 0 && clearance < infinity && !(list.full() && list.bound() < clearance))
  {
    return false;
  }
  collectNear(work.references, list, options_.neighbours, work.near);
  if (options_.neighbours == 0)
  {
    std::sort(work.near.begin(), work.near.end(), nearer);
    note(p, options_.radius * options_.radius);
  }
  else
  {
    note(p, list.full() ? list.bound() : infinity);
  }
  feature_.compute(p, work.near, work.values.data() + point * feature_.bytes());
  return true;
}

void Search::note(const glm::dvec3& p, double squaredReach) const
{
  if (known_ != nullptr)
  {
    known_->note(p, squaredReach);
  }
}

double Search::squaredReach(const NeighbourList& list, const glm::dvec3& p) const
{
  if (list.full())
  {
    return list.bound();
  }
  // All references of a tile that has enough of them are nearer than its farthest corner.
  double reach = infinity;
  for (std::size_t t = 0; t < tiles_.count(); ++t)
  {
    const ReferenceExtent& extent = tiles_.references(t);
    if (extent.points >= options_.neighbours)
    {
      reach = std::min(reach, squaredDistanceAcross(extent.bounds, p, options_.axes));
    }
  }
  return reach * (1.0 + 1e-12);
}

/// The neighbours that were found so far reach that far.
double Search::squaredReach(const std::vector<NearPoint>& found) const
{
  std::uint32_t count = 0;
  for (const NearPoint& near : found)
  {
    count += near.count;
  }
  return count < options_.neighbours ? infinity : found.back().squaredDistance * (1.0 + 1e-12);
}

/// Values of points[i] that are finished. The own points of a tile came from the sources in blocks,
/// each in input order: so there are long runs to write at once without a sort.
Result<void> Search::store(const std::vector<TilePoint>& points, const std::vector<bool>& finished,
  const std::vector<std::byte>& values) const
{
  const std::size_t bytes = feature_.bytes();
  std::vector<std::uint64_t> numbers;
  std::vector<std::byte> kept(finished.size() * bytes);
  numbers.reserve(finished.size());
  for (std::size_t i = 0; i < finished.size(); ++i)
  {
    if (finished[i])
    {
      std::memcpy(kept.data() + numbers.size() * bytes, values.data() + i * bytes, bytes);
      numbers.push_back(points[i].number());
    }
  }
  return column_.write(numbers, kept);
}

/// The second round: all tiles in reach of each point, one tile after another.
Result<void> Search::finishUnfinished()
{
  if (unfinished_.empty())
  {
    return {};
  }
  std::sort(unfinished_.begin(), unfinished_.end(),
    [](const auto& a, const auto& b) { return a.point.number() < b.point.number(); });
  std::vector<std::vector<NearPoint>> found(unfinished_.size());
  std::atomic<std::size_t> next{ 0 };
  const auto work = [&]() -> Result<void>
  {
    for (std::size_t t = next++; t < tiles_.count() && !crew_.stopped(); t = next++)
    {
      if (Result<void> done = searchAgain(t, found); !done)
      {
        return done;
      }
    }
    return {};
  };
  if (Result<void> done = crew_.run(work); !done)
  {
    return done;
  }
  std::vector<TilePoint> points(unfinished_.size());
  std::vector<std::byte> values(unfinished_.size() * feature_.bytes());
  for (std::size_t i = 0; i < unfinished_.size(); ++i)
  {
    points[i] = unfinished_[i].point;
    note(points[i].position, squaredReach(found[i]));
    feature_.compute(points[i].position, found[i], values.data() + i * feature_.bytes());
  }
  crew_.advance(points.size());
  unfinished_.clear();
  return store(points, std::vector<bool>(points.size(), true), values);
}

Result<void> Search::searchAgain(std::size_t tile, std::vector<std::vector<NearPoint>>& found)
{
  const ReferenceExtent& extent = tiles_.references(tile);
  std::vector<std::size_t> visitors;
  for (std::size_t i = 0; i < unfinished_.size() && extent.points > 0; ++i)
  {
    const UnfinishedPoint& from = unfinished_[i];
    if (squaredDistanceTo(extent.bounds, from.point.position, options_.axes) <= from.squaredReach)
    {
      visitors.push_back(i);
    }
  }
  if (visitors.empty())
  {
    return {};
  }
  const Result<std::vector<TilePoint>> own = tiles_.own(tile);
  if (!own)
  {
    return own.error();
  }
  PositionSet references;
  collectReferences(*own, placeOrder(*own), tiles_.participants().references, options_.axes,
    options_.neighbours, references);
  const std::unique_ptr<NeighbourIndex> index = makeIndex_(references);
  NeighbourList list(options_.neighbours);
  std::vector<NearPoint> near;
  for (const std::size_t i : visitors)
  {
    const glm::dvec3& position = unfinished_[i].point.position;
    // The neighbours from other tiles bring the reach nearer.
    std::unique_lock<std::mutex> lock(mutex_);
    const double reach = std::min(unfinished_[i].squaredReach, squaredReach(found[i]));
    lock.unlock();
    if (squaredDistanceTo(extent.bounds, position, options_.axes) > reach)
    {
      continue;
    }
    list.begin(references, reach);
    index->search(position, list);
    collectNear(references, list, options_.neighbours, near);
    lock.lock();
    merge(found[i], near);
  }
  return {};
}

/// Keeps the nearest of both; whichever tile comes first, the result is the same.
void Search::merge(std::vector<NearPoint>& found, const std::vector<NearPoint>& more) const
{
  found.insert(found.end(), more.begin(), more.end());
  std::sort(found.begin(), found.end(), nearer);
  std::uint32_t total = 0;
  std::size_t kept = 0;
  for (; kept < found.size() && total < options_.neighbours; ++kept)
  {
    found[kept].count = std::min(found[kept].count, options_.neighbours - total);
    total += found[kept].count;
  }
  found.resize(kept);
}
} // namespace

Result<std::unique_ptr<PointColumn>> computeFromNeighbours(const PointSources& sources,
  const InputOrder& order, const NeighbourhoodOptions& options, const IndexMaker& makeIndex,
  const NeighbourhoodFeature& feature, const PassResources& resources)
{
  TilingOptions tiling;
  tiling.axes = options.axes;
  tiling.tilePoints = options.tilePoints;
  tiling.neighbours = options.neighbours;
  // A little more than the radius: what lies exactly on it must not fall to rounding.
  tiling.halo = options.neighbours > 0 ? 0.0 : options.radius * (1.0 + 1e-9);
  WorkCrew reading(threadsOf(resources), resources.progress);
  Result<std::unique_ptr<PointTiles>> tiles =
    PointTiles::make(sources, order, tiling, options.participants, resources, reading, readShare);
  if (!tiles)
  {
    return tiles.error();
  }
  Result<std::unique_ptr<PointColumn>> column =
    PointColumn::create(resources, order.points(), feature.bytes());
  if (!column)
  {
    return column.error();
  }
  const Result<unsigned> threads = (*tiles)->threadsFor(tilePointBytes, resources);
  if (!threads)
  {
    return threads.error();
  }
  const std::uint64_t unfinishedBytes =
    sizeof(UnfinishedPoint) + (options.neighbours + 1) * sizeof(NearPoint);
  WorkCrew crew(*threads, resources.progress);
  crew.beginPhase(options.phase, 0, 2 * readShare);
  crew.beginPhase(options.phase, order.points(), searchShare);
  Search search(**tiles, options, makeIndex, feature, **column, crew, resources.known);
  const std::size_t mostUnfinished =
    std::max<std::uint64_t>(1024, memoryOf(resources) / 8 / unfinishedBytes);
  if (Result<void> done = search.run(mostUnfinished); !done)
  {
    return done.error();
  }
  return std::move(*column);
}

} // namespace pointfront
