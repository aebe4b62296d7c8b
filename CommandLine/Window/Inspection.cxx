#include "Inspection.h"

#include "PointPick.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace pointfront
{

namespace
{
const char* const nothingHere = "there is no point under the mouse";

void print(const nlohmann::ordered_json& object)
{
  using Handling = nlohmann::ordered_json::error_handler_t; // a path may be any bytes
  std::printf("%s\n", object.dump(-1, ' ', false, Handling::replace).c_str());
  std::fflush(stdout);
}
} // namespace

Inspection::Inspection(vtkRenderer* renderer, const MappedStores& stores)
  : renderer_(renderer)
  , stores_(stores)
  , marks_(renderer)
{
}

Result<std::string> Inspection::pick(const glm::ivec2& pixel)
{
  const Result<std::optional<PickedPoint>> found = pointAt(pixel, renderer_, stores_);
  if (!found)
  {
    return found.error();
  }
  clear();
  if (!*found)
  {
    return std::string(nothingHere);
  }
  const PickedPoint& point = **found;
  marks_.set({ point.position });
  print(jsonOf(point));
  return textOf(point);
}

Result<std::string> Inspection::measure(const glm::ivec2& pixel)
{
  const Result<std::optional<PickedPoint>> found = pointAt(pixel, renderer_, stores_);
  if (!found)
  {
    return found.error();
  }
  if (!*found)
  {
    return std::string(nothingHere);
  }
  const glm::dvec3 end = (*found)->position;
  if (!from_)
  {
    from_ = end;
    marks_.set({ end });
    return std::string("measuring: press m at the other end, or click it");
  }
  const Distance distance{ *from_, end };
  from_.reset();
  marks_.set({ distance.from, distance.to });
  print(jsonOf(distance));
  return textOf(distance);
}

void Inspection::clear()
{
  from_.reset();
  marks_.set({});
}

} // namespace pointfront
