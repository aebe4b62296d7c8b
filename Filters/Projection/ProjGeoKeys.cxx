// The meaning of GeoTIFF keys to PROJ: the part of ProjCoordinateSystems that knows their codes.
// Source   OGC GeoTIFF 1.1, annex B; GeoTIFF 1.0, section 6.3.4 for the old vertical codes.
#include "ProjCoordinateSystems.h"

#include "ProjSystem.h"

#include <proj.h>
#include <proj_experimental.h>

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{
struct LengthUnit
{
  std::uint16_t code;
  double metres;
  const char* name;
};
constexpr LengthUnit lengthUnits[] = { { 9001, 1.0, "metre" }, { 9002, 0.3048, "foot" },
  { 9003, 1200.0 / 3937.0, "US survey foot" } };

const LengthUnit* lengthUnit(std::optional<std::uint16_t> code)
{
  const auto* found = std::find_if(std::begin(lengthUnits), std::end(lengthUnits),
    [&](const LengthUnit& unit) { return unit.code == code; });
  return found == std::end(lengthUnits) ? nullptr : found;
}

/// A foot and a US survey foot differ by two millionths.
bool sameLength(double a, double b)
{
  return std::abs(a - b) <= 1e-8 * std::abs(b);
}

bool names(std::optional<std::uint16_t> code)
{
  return code && *code != 0 && *code != GeoKeys::userDefined;
}

std::string citation(const GeoKeys& keys)
{
  const std::string own = keys.text(GeoKeys::ProjectedCitation);
  const std::string text = own.empty() ? keys.text(GeoKeys::Citation) : own;
  return text.empty() ? "" : " ('" + text + "')";
}

std::string epsg(std::uint16_t code)
{
  return "EPSG:" + std::to_string(code);
}

/// NAVD88 has one code for each unit; writers give that of metres, or the old code of its datum.
std::uint16_t verticalCode(std::uint16_t code, std::optional<std::uint16_t> unit)
{
  constexpr std::uint16_t oldNavd88 = 5103;
  constexpr std::uint16_t navd88Metres = 5703;
  if (code != oldNavd88 && code != navd88Metres)
  {
    return code;
  }
  return unit == std::uint16_t(9003) ? 6360 : unit == std::uint16_t(9002) ? 8228 : navd88Metres;
}
} // namespace

Result<CoordinateSystem> ProjCoordinateSystems::fromGeoKeys(
  const GeoKeys& keys, std::vector<std::string>& warnings) const
{
  const auto projected = keys.code(GeoKeys::ProjectedSystem);
  const auto geodetic = keys.code(GeoKeys::GeodeticSystem);
  constexpr std::uint16_t projectedModel = 1;
  const bool isProjected = projected || keys.code(GeoKeys::ModelType) == projectedModel;
  const auto code = isProjected ? projected : geodetic;
  if (code == GeoKeys::userDefined)
  {
    return makeError(Error::Kind::Unsupported,
      "its GeoTIFF keys define a coordinate reference system" + citation(keys) +
        " of their own, without a code");
  }
  if (!names(code))
  {
    return makeError(Error::Kind::Unsupported,
      "its GeoTIFF keys name no coordinate reference system" + citation(keys));
  }
  Result<CoordinateSystem> system = parse(epsg(*code));
  if (!system)
  {
    return makeError(Error::Kind::Unsupported,
      "its GeoTIFF keys name the coordinate reference system " + epsg(*code) + citation(keys) +
        ", which PROJ does not know");
  }
  if (isProjected)
  {
    system = withUnit(std::move(*system), keys, warnings);
  }
  return system ? withHeights(std::move(*system), keys, warnings) : std::move(system);
}

/// Keys that give a projected system's code and another unit mean that system in that unit, as
/// other readers take it (GDAL): false easting and northing are converted.
Result<CoordinateSystem> ProjCoordinateSystems::withUnit(
  CoordinateSystem system, const GeoKeys& keys, std::vector<std::string>& warnings) const
{
  const LengthUnit* unit = lengthUnit(keys.code(GeoKeys::LinearUnit));
  if (unit == nullptr || system.geographic || sameLength(unit->metres, system.unitLength))
  {
    return system;
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  const std::string code = std::to_string(unit->code);
  const ProjObject crs = createSystem(context_, system.wkt);
  const ProjObject scaled(proj_crs_alter_parameters_linear_unit(
    context_.get(), crs.get(), unit->name, unit->metres, "EPSG", code.c_str(), 1));
  const ProjObject altered(scaled ? proj_crs_alter_cs_linear_unit(context_.get(), scaled.get(),
                                      unit->name, unit->metres, "EPSG", code.c_str())
                                  : nullptr);
  const ProjObject named(altered
      ? proj_alter_name(context_.get(), altered.get(),
          (std::string(proj_get_name(crs.get())) + " in " + unit->name).c_str())
      : nullptr);
  if (!named)
  {
    return makeError(Error::Kind::Unsupported,
      "its GeoTIFF keys name " + system.name + " and another unit, " + unit->name + ": " +
        context_.takeMessage());
  }
  warnings.push_back("The GeoTIFF keys name " + system.name + " and another unit, " + unit->name +
    ": taken to be that system in that unit.");
  return described(named.get());
}

Result<CoordinateSystem> ProjCoordinateSystems::withHeights(
  CoordinateSystem system, const GeoKeys& keys, std::vector<std::string>& warnings) const
{
  const auto given = keys.code(GeoKeys::VerticalSystem);
  if (!names(given) || system.vertical)
  {
    return system;
  }
  const std::uint16_t code = verticalCode(*given, keys.code(GeoKeys::VerticalUnit));
  Result<CoordinateSystem> both(system);
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    const ProjObject up = createSystem(context_, epsg(code));
    const ProjObject flat = createSystem(context_, system.wkt);
    ProjObject sum;
    if (up && flat && proj_get_type(up.get()) == PJ_TYPE_VERTICAL_CRS)
    {
      const std::string name =
        std::string(proj_get_name(flat.get())) + " + " + proj_get_name(up.get());
      sum.reset(proj_create_compound_crs(context_.get(), name.c_str(), flat.get(), up.get()));
    }
    context_.takeMessage();
    if (sum)
    {
      both = described(sum.get());
    }
    else
    {
      warnings.push_back("The GeoTIFF keys name heights by the code " + std::to_string(*given) +
        ", which is no vertical system that PROJ knows: left out.");
    }
  }
  return both;
}

} // namespace pointfront
