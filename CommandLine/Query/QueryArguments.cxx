#include "QueryArguments.h"

#include "BoxOption.h"
#include "MapGeometry.h"
#include "Values.h"

#include "pointfront/Query/BoxRegion.h"
#include "pointfront/Query/LineCorridor.h"
#include "pointfront/Query/PolygonPrism.h"
#include "pointfront/Query/SphereRegion.h"

#include <utility>

namespace pointfront
{
namespace
{

/// A region that is made, among the query's.
template <typename RegionResult>
Result<void> add(PointQuery& query, const RegionResult& region)
{
  if (!region)
  {
    return region.error();
  }
  query.regions.push_back(*region);
  return {};
}

Error without(const std::string& path, const char* what)
{
  return makeError(Error::Kind::BadArgument, path + ": the file holds no " + what);
}

} // namespace

void QueryArguments::declare(CLI::App& app)
{
  declareRegions(app);
  declareConditions(app);
}

void QueryArguments::declareRegions(CLI::App& app)
{
  declareBox(app, "Only points inside or on this box", [this](const Bounds& box) { box_ = box; });
  app
    .add_option("--polygon", polygonPath_,
      "Only points above or below the areas of this file (GeoJSON or WKT)")
    ->type_name("FILE")
    ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  const auto sphere = [this](const CLI::results_t& words)
  {
    sphere_ = parseNumbers<4>(words.back());
    if (!sphere_ || (*sphere_)[3] < 0.0)
    {
      throw CLI::ParseError("--sphere: '" + words.back() +
          "' is not a sphere: write x,y,z,r with a radius of 0 or more",
        2);
    }
    return true;
  };
  app.add_option("--sphere", sphere, "Only points inside or on this sphere")
    ->type_name("x,y,z,r")
    ->expected(1);
  CLI::Option* const corridor =
    app
      .add_option("--corridor", corridorPath_,
        "Only points that lie --within a distance of the lines of this file, on the map")
      ->type_name("FILE")
      ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  CLI::Option* const within =
    app.add_option("--within", within_, "Distance of --corridor to each side")
      ->check(positiveNumber())
      ->type_name("METRES");
  within->needs(corridor);
  corridor->needs(within);
}

void QueryArguments::declareConditions(CLI::App& app)
{
  const auto classes = [this](const CLI::results_t& words)
  {
    const auto codes = parseClasses(words.back());
    if (!codes)
    {
      throw CLI::ParseError(
        "--classes: '" + words.back() + "' is not a list of class codes: write 2,6", 2);
    }
    query_.classes = *codes;
    return true;
  };
  app.add_option("--classes", classes, "Only points of these classes")
    ->type_name("LIST")
    ->expected(1);
  const auto where = [this](const CLI::results_t& words)
  {
    Result<FilterExpression> expression = FilterExpression::parse(words.back());
    if (!expression)
    {
      throw CLI::ParseError("--where: " + expression.error().what, 2);
    }
    if (expression->empty())
    {
      throw CLI::ParseError(std::string("--where: ") + noCondition, 2);
    }
    query_.where = std::move(*expression);
    return true;
  };
  app
    .add_option("--where", where,
      "Only points that meet it: 'ATTRIBUTE in [a, b]', 'in {1, 2}', ==, !=, <, <=, >, >=, and")
    ->type_name("CONDITION")
    ->expected(1)
    ->multi_option_policy(CLI::MultiOptionPolicy::TakeLast);
  app
    .add_option(
      "--spacing", query_.spacing, "Thin out: levels until the points are at least this dense")
    ->check(positiveNumber())
    ->type_name("METRES");
}

std::vector<std::string> QueryArguments::files() const
{
  return { polygonPath_, corridorPath_ };
}

Result<void> QueryArguments::addPolygon(
  const StoreDescription& store, PointQuery& query, std::vector<std::string>& notes) const
{
  const Result<PlanarGeometry> areas = readMapGeometry(polygonPath_, store, notes);
  if (!areas)
  {
    return areas.error();
  }
  if (areas->polygons.empty())
  {
    return without(polygonPath_, "area: a line is asked for with --corridor");
  }
  const auto prism = PolygonPrism::make(areas->polygons);
  if (prism && !(*prism)->bounds().overlaps(store.bounds))
  {
    notes.push_back(polygonPath_ + ": the areas lie outside of the store; are they in its system?");
  }
  return add(query, prism);
}

Result<void> QueryArguments::addCorridor(
  const StoreDescription& store, PointQuery& query, std::vector<std::string>& notes) const
{
  const Result<PlanarGeometry> lines = readMapGeometry(corridorPath_, store, notes);
  if (!lines)
  {
    return lines.error();
  }
  if (lines->lines.empty())
  {
    return without(corridorPath_, "line: an area is asked for with --polygon");
  }
  const auto corridor = LineCorridor::make(lines->lines, within_);
  if (corridor && !(*corridor)->bounds().overlaps(store.bounds))
  {
    notes.push_back(
      corridorPath_ + ": the lines lie outside of the store; are they in its system?");
  }
  return add(query, corridor);
}

Result<PointQuery> QueryArguments::query(
  const StoreDescription& store, std::vector<std::string>& notes) const
{
  PointQuery query = query_;
  Result<void> done;
  if (box_)
  {
    done = add(query, BoxRegion::make(*box_));
  }
  if (done && sphere_)
  {
    const auto& s = *sphere_;
    done = add(query, SphereRegion::make({ s[0], s[1], s[2] }, s[3]));
  }
  if (done && !polygonPath_.empty())
  {
    done = addPolygon(store, query, notes);
  }
  if (done && !corridorPath_.empty())
  {
    done = addCorridor(store, query, notes);
  }
  return done ? Result<PointQuery>(std::move(query)) : done.error();
}

} // namespace pointfront
