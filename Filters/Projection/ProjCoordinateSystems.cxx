#include "ProjCoordinateSystems.h"

#include "ProjSystem.h"
#include "ProjTransform.h"

#include <proj.h>
#include <proj_experimental.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pointfront
{
namespace
{
/// Long definitions are cut in messages.
std::string shown(const std::string& definition)
{
  constexpr std::size_t most = 60;
  return definition.size() <= most ? definition : definition.substr(0, most) + "...";
}

/// Source   Army Map Service TM 8-358: the zones off Norway (32V) and Svalbard (31X to 37X).
int utmZoneNumber(double longitude, double latitude)
{
  if (latitude >= 56.0 && latitude < 64.0 && longitude >= 3.0 && longitude < 12.0)
  {
    return 32;
  }
  if (latitude >= 72.0 && longitude >= 0.0 && longitude < 42.0)
  {
    return longitude < 9.0 ? 31 : longitude < 21.0 ? 33 : longitude < 33.0 ? 35 : 37;
  }
  const int zone = static_cast<int>(std::floor((longitude + 180.0) / 6.0)) + 1;
  return std::min(60, std::max(1, zone));
}
} // namespace

Result<CoordinateSystem> ProjCoordinateSystems::described(const PJconsts* crs) const
{
  return describeSystem(context_, crs);
}

Result<CoordinateSystem> ProjCoordinateSystems::parse(const std::string& definition) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const ProjObject crs = createSystem(context_, definition);
  if (!crs)
  {
    const std::string reason = context_.takeMessage();
    return makeError(Error::Kind::BadArgument,
      "'" + shown(definition) + "' is no coordinate reference system that PROJ knows" +
        (reason.empty() ? "" : " (" + reason + ")") +
        "; give a code such as EPSG:32632, or a file that holds WKT");
  }
  return described(crs.get());
}

bool ProjCoordinateSystems::equivalent(
  const CoordinateSystem& a, const CoordinateSystem& b, bool horizontally) const
{
  if (a.wkt == b.wkt)
  {
    return true;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  ProjObject first = createSystem(context_, a.wkt);
  ProjObject second = createSystem(context_, b.wkt);
  if (first && second && horizontally)
  {
    first = horizontalPart(context_, first.get());
    second = horizontalPart(context_, second.get());
  }
  return first && second &&
    proj_is_equivalent_to_with_ctx(
      context_.get(), first.get(), second.get(), PJ_COMP_EQUIVALENT_EXCEPT_AXIS_ORDER_GEOGCRS) != 0;
}

Result<std::unique_ptr<CoordinateTransform>> ProjCoordinateSystems::transform(
  const CoordinateSystem& from, const CoordinateSystem& to, const Bounds& where) const
{
  auto context = std::make_unique<ProjContext>();
  ProjObject source = createSystem(*context, from.wkt);
  ProjObject target = createSystem(*context, to.wkt);
  if (!source || !target)
  {
    return makeError(Error::Kind::BadArgument,
      "the coordinate reference system " + (source ? to.name : from.name) +
        " is not understood: " + context->takeMessage());
  }
  const auto upright = [&](ProjObject crs, const CoordinateSystem& system)
  {
    return system.vertical ? std::move(crs)
                           : ProjObject(proj_crs_promote_to_3D(context->get(), nullptr, crs.get()));
  };
  if (from.geocentric || to.geocentric)
  {
    source = upright(std::move(source), from);
    target = upright(std::move(target), to);
  }
  else if (!from.vertical || !to.vertical)
  {
    source = horizontalPart(*context, source.get());
    target = horizontalPart(*context, target.get());
  }
  return ProjTransform::create(context, source.get(), target.get(), where);
}

Result<CoordinateSystem> ProjCoordinateSystems::compound(
  const CoordinateSystem& horizontal, const CoordinateSystem& heights) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const ProjObject flat = createSystem(context_, horizontal.wkt);
  const ProjObject tall = createSystem(context_, heights.wkt);
  const ProjObject base = flat ? horizontalPart(context_, flat.get()) : nullptr;
  const ProjObject up = tall ? verticalPart(context_, tall.get()) : nullptr;
  ProjObject both;
  if (base && up)
  {
    const std::string name =
      std::string(proj_get_name(base.get())) + " + " + proj_get_name(up.get());
    both.reset(proj_create_compound_crs(context_.get(), name.c_str(), base.get(), up.get()));
  }
  else if (base && heights.vertical) // heights above the ellipsoid
  {
    both.reset(proj_crs_promote_to_3D(context_.get(), nullptr, base.get()));
  }
  if (!both)
  {
    return makeError(Error::Kind::BadArgument,
      horizontal.name + " cannot be given the heights of " + heights.name + ": " +
        context_.takeMessage());
  }
  return described(both.get());
}

Result<CoordinateSystem> ProjCoordinateSystems::utmZone(
  const CoordinateSystem& system, const glm::dvec3& where) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  const ProjObject crs = createSystem(context_, system.wkt);
  const ProjObject flat = crs ? horizontalPart(context_, crs.get()) : nullptr;
  const ProjObject base(flat ? proj_crs_get_geodetic_crs(context_.get(), flat.get()) : nullptr);
  const ProjObject geodetic = base ? horizontalPart(context_, base.get()) : nullptr;
  const ProjObject raw(geodetic
      ? proj_create_crs_to_crs_from_pj(context_.get(), flat.get(), geodetic.get(), nullptr, nullptr)
      : nullptr);
  const ProjObject toDegrees(
    raw ? proj_normalize_for_visualization(context_.get(), raw.get()) : nullptr);
  if (!toDegrees)
  {
    return makeError(Error::Kind::BadArgument,
      "no UTM zone can be found for " + system.name + ": " + context_.takeMessage());
  }
  const PJ_COORD p =
    proj_trans(toDegrees.get(), PJ_FWD, proj_coord(where.x, where.y, where.z, 0.0));
  if (!(std::abs(p.xy.x) <= 360.0) || p.xy.y < -80.0 || p.xy.y > 84.0)
  {
    return makeError(Error::Kind::BadArgument,
      "the points lie outside of the UTM zones (80 S to 84 N); name a projected coordinate "
      "reference system instead");
  }
  const double longitude = p.xy.x - 360.0 * std::floor((p.xy.x + 180.0) / 360.0);
  const int zone = utmZoneNumber(longitude, p.xy.y);
  const bool north = p.xy.y >= 0.0;
  const ProjObject conversion(proj_create_conversion_utm(context_.get(), zone, north ? 1 : 0));
  const ProjObject axes(
    proj_create_cartesian_2D_cs(context_.get(), PJ_CART2D_EASTING_NORTHING, "metre", 1.0));
  const std::string name = std::string(proj_get_name(geodetic.get())) + " / UTM zone " +
    std::to_string(zone) + (north ? "N" : "S");
  const ProjObject projected(proj_create_projected_crs(
    context_.get(), name.c_str(), geodetic.get(), conversion.get(), axes.get()));
  if (!projected)
  {
    return makeError(Error::Kind::BadArgument, name + ": " + context_.takeMessage());
  }
  return described(projected.get());
}

} // namespace pointfront
