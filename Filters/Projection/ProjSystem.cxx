#include "ProjSystem.h"

#include <proj.h>
#include <proj_experimental.h>

#include <utility>

namespace pointfront
{
namespace
{
std::string nameOf(const PJconsts* crs)
{
  const char* name = proj_get_name(crs);
  const char* authority = proj_get_id_auth_name(crs, 0);
  const char* code = proj_get_id_code(crs, 0);
  std::string text = name != nullptr && *name != '\0' ? name : "unnamed";
  if (authority != nullptr && code != nullptr)
  {
    text += std::string(" (") + authority + ":" + code + ")";
  }
  return text;
}

/// WKT 1 with the heights of a system of three axes dropped would be a lie: those get WKT 2.
std::string wktOf(const ProjContext& context, const PJconsts* crs)
{
  const char* const oneLine[] = { "MULTILINE=NO", nullptr };
  const PJ_TYPE type = proj_get_type(crs);
  const char* wkt = type == PJ_TYPE_GEOGRAPHIC_3D_CRS
    ? nullptr
    : proj_as_wkt(context.get(), crs, PJ_WKT1_GDAL, oneLine);
  if (wkt == nullptr)
  {
    wkt = proj_as_wkt(context.get(), crs, PJ_WKT2_2019, oneLine);
  }
  context.takeMessage(); // that a system has no WKT 1 is no news
  return wkt != nullptr ? wkt : "";
}

struct Axes
{
  int count = 0;
  double first = 1.0; ///< unit of the first axis: metres or radians
  double last = 1.0; ///< unit of the last axis
};

Axes axesOf(const ProjContext& context, const PJconsts* crs)
{
  Axes axes;
  const ProjObject cs(proj_crs_get_coordinate_system(context.get(), crs));
  if (!cs)
  {
    return axes;
  }
  axes.count = proj_cs_get_axis_count(context.get(), cs.get());
  const auto unit = [&](int axis, double& factor)
  {
    proj_cs_get_axis_info(
      context.get(), cs.get(), axis, nullptr, nullptr, nullptr, &factor, nullptr, nullptr, nullptr);
  };
  if (axes.count > 0)
  {
    unit(0, axes.first);
    unit(axes.count - 1, axes.last);
  }
  return axes;
}

bool isGeographic(PJ_TYPE type)
{
  return type == PJ_TYPE_GEOGRAPHIC_2D_CRS || type == PJ_TYPE_GEOGRAPHIC_3D_CRS;
}
} // namespace

ProjObject unbound(const ProjContext& context, ProjObject crs)
{
  if (proj_get_type(crs.get()) == PJ_TYPE_BOUND_CRS)
  {
    ProjObject base(proj_get_source_crs(context.get(), crs.get()));
    if (base && proj_get_id_code(base.get(), 0) != nullptr)
    {
      return base;
    }
  }
  return crs;
}

ProjObject horizontalPart(const ProjContext& context, const PJconsts* crs)
{
  ProjObject part(proj_get_type(crs) == PJ_TYPE_COMPOUND_CRS
      ? proj_crs_get_sub_crs(context.get(), crs, 0)
      : proj_clone(context.get(), crs));
  part = unbound(context, std::move(part));
  if (proj_get_type(part.get()) == PJ_TYPE_GEOCENTRIC_CRS || axesOf(context, part.get()).count != 3)
  {
    return part;
  }
  return ProjObject(proj_crs_demote_to_2D(context.get(), nullptr, part.get()));
}

ProjObject verticalPart(const ProjContext& context, const PJconsts* crs)
{
  return ProjObject(proj_get_type(crs) == PJ_TYPE_COMPOUND_CRS
      ? proj_crs_get_sub_crs(context.get(), crs, 1)
      : nullptr);
}

ProjObject createSystem(const ProjContext& context, const std::string& definition)
{
  context.takeMessage();
  ProjObject object(proj_create(context.get(), definition.c_str()));
  if (!object || !proj_is_crs(object.get()))
  {
    return nullptr;
  }
  return unbound(context, std::move(object));
}

Result<CoordinateSystem> describeSystem(const ProjContext& context, const PJconsts* crs)
{
  CoordinateSystem system;
  system.name = nameOf(crs);
  system.wkt = wktOf(context, crs);
  const ProjObject flat = horizontalPart(context, crs);
  const PJ_TYPE type = flat ? proj_get_type(flat.get()) : PJ_TYPE_UNKNOWN;
  if (type == PJ_TYPE_VERTICAL_CRS || type == PJ_TYPE_TEMPORAL_CRS || type == PJ_TYPE_UNKNOWN ||
    system.wkt.empty())
  {
    return makeError(Error::Kind::Unsupported,
      "the coordinate reference system " + system.name +
        " has no horizontal axes; name a projected or geographic one");
  }
  ProjObject plain(type == PJ_TYPE_BOUND_CRS ? proj_get_source_crs(context.get(), flat.get())
                                             : proj_clone(context.get(), flat.get()));
  const Axes axes = axesOf(context, plain.get());
  system.geographic = isGeographic(proj_get_type(plain.get()));
  system.geocentric = type == PJ_TYPE_GEOCENTRIC_CRS;
  system.unitLength = axes.first;
  if (const ProjObject up = verticalPart(context, crs))
  {
    system.vertical = true;
    system.heightUnit = axesOf(context, up.get()).last;
  }
  else if (const Axes all = axesOf(context, crs); all.count == 3)
  {
    system.vertical = true;
    system.heightUnit = all.last;
  }
  return system;
}

} // namespace pointfront
