#include "ProjTransform.h"

#include "ProjSystem.h"

#include "pointfront/Base/NumberText.h"

#include <proj.h>

#include <cmath>
#include <utility>

namespace pointfront
{
namespace
{
struct AreaDestroy
{
  void operator()(PJ_AREA* area) const { proj_area_destroy(area); }
};
struct ListDestroy
{
  void operator()(PJ_OBJ_LIST* list) const { proj_list_destroy(list); }
};
struct FactoryDestroy
{
  void operator()(PJ_OPERATION_FACTORY_CONTEXT* factory) const
  {
    proj_operation_factory_context_destroy(factory);
  }
};

/// Degrees east and north.
struct Region
{
  Bounds degrees;
  bool known() const
  {
    return !degrees.empty() && degrees.low.x >= -180.0 && degrees.high.x <= 180.0 &&
      degrees.low.y >= -90.0 && degrees.high.y <= 90.0;
  }
};

constexpr int latticeSide = 5;

/// The extent of `where` in longitude and latitude, without a change of datum.
Region regionOf(const ProjContext& context, const PJconsts* crs, const Bounds& where)
{
  Region region;
  const ProjObject flat = horizontalPart(context, crs);
  if (where.empty() || !flat || proj_get_type(flat.get()) == PJ_TYPE_GEOCENTRIC_CRS)
  {
    return region;
  }
  const ProjObject geodetic(proj_crs_get_geodetic_crs(context.get(), flat.get()));
  const ProjObject raw(geodetic
      ? proj_create_crs_to_crs_from_pj(context.get(), flat.get(), geodetic.get(), nullptr, nullptr)
      : nullptr);
  const ProjObject operation(
    raw ? proj_normalize_for_visualization(context.get(), raw.get()) : nullptr);
  for (int i = 0; operation && i < latticeSide * latticeSide; ++i)
  {
    const int line = i / latticeSide;
    const double column = double(i % latticeSide) / (latticeSide - 1);
    const double row = double(line) / (latticeSide - 1);
    const glm::dvec3 size = where.size();
    const PJ_COORD p = proj_trans(operation.get(), PJ_FWD,
      proj_coord(where.low.x + size.x * column, where.low.y + size.y * row, 0.0, 0.0));
    if (std::isfinite(p.xy.x) && std::isfinite(p.xy.y))
    {
      region.degrees.add({ p.xy.x, p.xy.y, 0.0 });
    }
  }
  context.takeMessage();
  return region;
}

std::string missingGrids(const ProjContext& context, const PJconsts* operation)
{
  std::string names;
  const int count = proj_coordoperation_get_grid_used_count(context.get(), operation);
  for (int i = 0; i < count; ++i)
  {
    const char* name = nullptr;
    int available = 0;
    proj_coordoperation_get_grid_used(
      context.get(), operation, i, &name, nullptr, nullptr, nullptr, nullptr, nullptr, &available);
    if (available == 0 && name != nullptr)
    {
      names += (names.empty() ? "" : ", ") + std::string(name);
    }
  }
  return names;
}

std::string accuracyOf(const ProjContext& context, const PJconsts* operation)
{
  const double metres = proj_coordoperation_get_accuracy(context.get(), operation);
  return metres >= 0.0 ? numberText(metres, 6) + " m" : "an unknown number of metres";
}

/// Is the best transformation usable here, and if not, how good is what is used instead?
std::vector<std::string> doubts(const ProjContext& context, const PJconsts* from,
  const PJconsts* to, const Region& region, const std::string& names)
{
  const std::unique_ptr<PJ_OPERATION_FACTORY_CONTEXT, FactoryDestroy> factory(
    proj_create_operation_factory_context(context.get(), nullptr));
  proj_operation_factory_context_set_spatial_criterion(
    context.get(), factory.get(), PROJ_SPATIAL_CRITERION_PARTIAL_INTERSECTION);
  proj_operation_factory_context_set_grid_availability_use(
    context.get(), factory.get(), PROJ_GRID_AVAILABILITY_IGNORED);
  if (region.known())
  {
    const Bounds& b = region.degrees;
    proj_operation_factory_context_set_area_of_interest(
      context.get(), factory.get(), b.low.x, b.low.y, b.high.x, b.high.y);
  }
  const std::unique_ptr<PJ_OBJ_LIST, ListDestroy> list(
    proj_create_operations(context.get(), from, to, factory.get()));
  std::vector<std::string> sentences;
  std::string wanted;
  const int count = list ? proj_list_get_count(list.get()) : 0;
  for (int i = 0; i < count; ++i)
  {
    const ProjObject operation(proj_list_get(context.get(), list.get(), i));
    if (proj_coordoperation_is_instantiable(context.get(), operation.get()) == 0)
    {
      if (wanted.empty())
      {
        wanted = "the best transformation, good to " + accuracyOf(context, operation.get()) +
          ", needs " + missingGrids(context, operation.get()) +
          ", which PROJ does not find here (package proj-data)";
      }
      continue;
    }
    if (!wanted.empty())
    {
      sentences.push_back("From " + names + ": " + wanted + "; one good to " +
        accuracyOf(context, operation.get()) + " is used.");
    }
    if (proj_coordoperation_has_ballpark_transformation(context.get(), operation.get()) != 0)
    {
      sentences.push_back(
        "From " + names + ": no exact transformation is known; coordinates may be off by metres.");
    }
    break;
  }
  context.takeMessage();
  return sentences;
}
} // namespace

Result<std::unique_ptr<CoordinateTransform>> ProjTransform::create(
  std::unique_ptr<ProjContext>& context, const PJconsts* from, const PJconsts* to,
  const Bounds& where)
{
  const std::string names = std::string(proj_get_name(from)) + " to " + proj_get_name(to);
  const Region region = regionOf(*context, from, where);
  std::unique_ptr<PJ_AREA, AreaDestroy> area;
  if (region.known())
  {
    const Bounds& b = region.degrees;
    area.reset(proj_area_create());
    proj_area_set_bbox(area.get(), b.low.x, b.low.y, b.high.x, b.high.y);
  }
  context->takeMessage();
  const ProjObject raw(
    proj_create_crs_to_crs_from_pj(context->get(), from, to, area.get(), nullptr));
  ProjObject object(raw ? proj_normalize_for_visualization(context->get(), raw.get()) : nullptr);
  if (!object)
  {
    const std::string reason = context->takeMessage();
    return makeError(Error::Kind::BadArgument,
      "no transformation from " + names + " is known" + (reason.empty() ? "" : ": " + reason));
  }
  std::vector<std::string> warnings = doubts(*context, from, to, region, names);
  std::unique_ptr<ProjTransform> made(
    new ProjTransform(std::move(context), std::move(object), names));
  made->warnings_ = std::move(warnings);
  return std::unique_ptr<CoordinateTransform>(std::move(made));
}

std::unique_ptr<ProjTransform::Copy> ProjTransform::borrow() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!spare_.empty())
  {
    std::unique_ptr<Copy> copy = std::move(spare_.back());
    spare_.pop_back();
    return copy;
  }
  auto copy = std::make_unique<Copy>();
  copy->object.reset(proj_clone(copy->context.get(), object_.get()));
  return copy;
}

void ProjTransform::giveBack(std::unique_ptr<Copy> copy) const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  spare_.push_back(std::move(copy));
}

Result<void> ProjTransform::apply(glm::dvec3* points, std::size_t count) const
{
  std::size_t asked = 0;
  glm::dvec3 example(0.0);
  for (std::size_t i = 0; i < count; ++i)
  {
    const glm::dvec3& p = points[i];
    if (std::isfinite(p.x + p.y + p.z))
    {
      example = p;
      ++asked;
    }
  }
  if (asked == 0)
  {
    return {};
  }
  std::unique_ptr<Copy> copy = borrow();
  if (!copy->object)
  {
    return makeError(Error::Kind::NoMemory, "PROJ could not copy the transformation " + names_);
  }
  proj_errno_reset(copy->object.get());
  constexpr std::size_t stride = sizeof(glm::dvec3);
  proj_trans_generic(copy->object.get(), PJ_FWD, &points->x, stride, count, &points->y, stride,
    count, &points->z, stride, count, nullptr, 0, 0);
  std::size_t arrived = 0;
  for (std::size_t i = 0; i < count; ++i)
  {
    arrived += std::isfinite(points[i].x + points[i].y + points[i].z) ? 1 : 0;
  }
  const int code = proj_errno(copy->object.get());
  const char* reason = code != 0 ? proj_context_errno_string(copy->context.get(), code) : nullptr;
  const std::string why = reason != nullptr ? std::string(": ") + reason : std::string();
  copy->context.takeMessage();
  giveBack(std::move(copy));
  if (arrived == 0)
  {
    const std::string where = "(" + numberText(example.x, 10) + ", " + numberText(example.y, 10) +
      ", " + numberText(example.z, 10) + ")";
    return makeError(Error::Kind::BadArgument,
      "not one of " + std::to_string(asked) + " points, such as " + where +
        ", can be transformed from " + names_ + why +
        "; is their coordinate reference system right?");
  }
  return {};
}

} // namespace pointfront
