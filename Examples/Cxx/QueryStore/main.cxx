// Asks a store for the points of an area that meet a condition, and streams them: their number,
// their mean height, and the one point that is highest, read again by its id.
//   QueryStore STORE.pfront 'POLYGON ((x y, ...))' CONDITION
//   QueryStore city.pfront 'POLYGON ((0 0, 80 0, 80 80, 0 0))' 'classification in {6}'
#include <pointfront/Query/PointsById.h>
#include <pointfront/Query/PolygonPrism.h>
#include <pointfront/Query/QueryPlan.h>
#include <pointfront/Query/WellKnownText.h>
#include <pointfront/Store/PointStore.h>

#include <cstdint>
#include <cstdio>
#include <limits>

using namespace pointfront;

namespace
{

Result<void> report(const char* path, const char* area, const char* condition)
{
  const auto store = PointStore::open(path);
  const auto geometry = parseWellKnownText(area);
  const auto where = FilterExpression::parse(condition);
  if (!store || !geometry || !where)
  {
    return !store ? store.error() : !geometry ? geometry.error() : where.error();
  }
  const auto prism = PolygonPrism::make(geometry->polygons);
  if (!prism)
  {
    return prism.error();
  }
  PointQuery query;
  query.regions = { *prism };
  query.where = *where;
  query.attributes.emplace(); // no attributes come out: only what the condition needs is read

  // Batches come in the store's order, whatever the number of threads that read.
  double sum = 0.0;
  double highest = -std::numeric_limits<double>::infinity();
  std::uint64_t id = 0;
  const auto asked = queryPoints(**store, query, {},
    [&](QueryBatch& batch) -> Result<void>
    {
      for (std::size_t i = 0; i < batch.size(); ++i)
      {
        const double z = batch.points.positions[i].z;
        sum += z;
        id = z > highest ? batch.ids[i] : id;
        highest = z > highest ? z : highest;
      }
      return {};
    });
  if (!asked)
  {
    return asked.error();
  }
  std::printf("%llu points of %llu, %llu bytes read\n",
    static_cast<unsigned long long>(asked->pointsChosen),
    static_cast<unsigned long long>((*store)->description().pointCount),
    static_cast<unsigned long long>(asked->bytesRead));
  if (asked->pointsChosen == 0)
  {
    return {};
  }
  std::printf("mean height %.2f\n", sum / static_cast<double>(asked->pointsChosen));

  const auto again = pointsById(**store, { id }, std::nullopt, {},
    [](QueryBatch& batch) -> Result<void>
    {
      const glm::dvec3& p = batch.points.positions[0];
      std::printf("highest: point %llu at %.2f %.2f %.2f\n",
        static_cast<unsigned long long>(batch.ids[0]), p.x, p.y, p.z);
      return {};
    });
  return again ? Result<void>() : again.error();
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc != 4)
  {
    std::fprintf(stderr, "usage: QueryStore STORE.pfront 'POLYGON ((x y, ...))' CONDITION\n");
    return 2;
  }
  const Result<void> done = report(argv[1], argv[2], argv[3]);
  if (!done)
  {
    std::fprintf(stderr, "%s\n", done.error().what.c_str());
    return 1;
  }
  return 0;
}
