#include "CameraJson.h"

#include "pointfront/Points/QuantisationGrid.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <fstream>
#include <sstream>

namespace pointfront
{

namespace
{
Error badKey(const std::string& where, const char* key, const char* expected)
{
  return makeError(Error::Kind::BadFormat, where + ": \"" + key + "\" must be " + expected);
}

bool readVector(const nlohmann::json& object, const char* key, glm::dvec3& vector)
{
  const auto entry = object.find(key);
  if (entry == object.end() || !entry->is_array() || entry->size() != 3)
  {
    return false;
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    const nlohmann::json& number = (*entry)[static_cast<std::size_t>(axis)];
    if (!number.is_number() || std::abs(number.get<double>()) > farthestCoordinate)
    {
      return false;
    }
    vector[axis] = number.get<double>();
  }
  return true;
}

/// False if the key is there and is not a positive number.
bool readPositive(const nlohmann::json& object, const char* key, std::optional<double>& value)
{
  const auto entry = object.find(key);
  if (entry == object.end())
  {
    return true;
  }
  if (!entry->is_number() || !(entry->get<double>() > 0.0) ||
    entry->get<double>() > farthestCoordinate)
  {
    return false;
  }
  value = entry->get<double>();
  return true;
}
} // namespace

Result<nlohmann::json> readJsonFile(const std::string& path)
{
  std::ifstream file(path);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
  {
    return makeError(Error::Kind::Unreadable, path + ": cannot read the file");
  }
  try
  {
    return nlohmann::json::parse(text.str());
  }
  catch (const nlohmann::json::parse_error& failure)
  {
    return makeError(
      Error::Kind::BadFormat, path + ": not JSON, at byte " + std::to_string(failure.byte));
  }
  catch (const nlohmann::json::out_of_range&)
  {
    return makeError(Error::Kind::BadFormat,
      path + ": a number in it is too large for double precision; write one below 1e308");
  }
}

Result<Camera> cameraFromJson(const nlohmann::json& object, const std::string& where)
{
  if (!object.is_object())
  {
    return makeError(Error::Kind::BadFormat, where + ": a camera is a JSON object");
  }
  Camera camera;
  if (!readVector(object, "position", camera.position))
  {
    return badKey(where, "position", "three numbers of at most 1e15");
  }
  if (!readVector(object, "focal_point", camera.focalPoint))
  {
    return badKey(where, "focal_point", "three numbers of at most 1e15");
  }
  if (!readVector(object, "view_up", camera.viewUp))
  {
    return badKey(where, "view_up", "three numbers of at most 1e15");
  }
  std::optional<double> angle;
  if (!readPositive(object, "view_angle", angle) || (angle && *angle >= 180.0))
  {
    return badKey(where, "view_angle", "degrees between 0 and 180");
  }
  if (!readPositive(object, "parallel_scale", camera.parallelScale))
  {
    return badKey(where, "parallel_scale", "a positive number of at most 1e15");
  }
  camera.viewAngleDegrees = angle.value_or(camera.viewAngleDegrees);
  const glm::dvec3 sight = camera.focalPoint - camera.position;
  if (!(glm::length(glm::cross(sight, camera.viewUp)) >
        1.0e-9 * glm::length(sight) * glm::length(camera.viewUp)))
  {
    return makeError(Error::Kind::BadFormat,
      where + ": \"view_up\" must not be parallel to the direction of sight, nor any of them zero");
  }
  return camera;
}

nlohmann::ordered_json jsonOf(const Camera& camera)
{
  const auto numbers = [](const glm::dvec3& v) { return nlohmann::ordered_json{ v.x, v.y, v.z }; };
  nlohmann::ordered_json object;
  object["position"] = numbers(camera.position);
  object["focal_point"] = numbers(camera.focalPoint);
  object["view_up"] = numbers(camera.viewUp);
  if (camera.parallelScale)
  {
    object["parallel_scale"] = *camera.parallelScale;
  }
  else
  {
    object["view_angle"] = camera.viewAngleDegrees;
  }
  return object;
}

} // namespace pointfront
