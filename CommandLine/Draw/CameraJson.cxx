#include "CameraJson.h"

#include "pointfront/Base/NearestName.h"
#include "pointfront/Points/QuantisationGrid.h"

#include <glm/geometric.hpp>

#include <cmath>
#include <fstream>
#include <sstream>
#include <vector>

namespace pointfront
{

namespace
{
const std::vector<std::string> cameraKeys{ "position", "focal_point", "view_up", "view_angle",
  "parallel_scale", "frames" };

/// The key at fault is there, or missing, or there under a name that is nearly its own.
Error badKey(const nlohmann::json& object, const std::string& where, const JSONText* text,
  const char* key, const char* expected)
{
  const nlohmann::json* faulty = object.contains(key) ? &object.at(key) : &object;
  std::string fault = std::string("\"") + key + "\" must be " + expected;
  for (const auto& [name, value] : object.items())
  {
    if (!object.contains(key) && nearestName(name, cameraKeys) == key)
    {
      faulty = &value;
      fault = "there is no key '" + name + "'" + didYouMean(name, cameraKeys);
    }
  }
  return makeError(
    Error::Kind::BadFormat, where + ": " + (text ? text->lineOf(*faulty) : std::string()) + fault);
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

Result<JSONText> readJsonFile(const std::string& path)
{
  std::ifstream file(path);
  std::ostringstream text;
  if (!file || !(text << file.rdbuf()))
  {
    return makeError(Error::Kind::Unreadable, path + ": cannot read the file");
  }
  Result<JSONText> json = JSONText::parse(text.str());
  return json ? std::move(json) : makeError(json.error().kind, path + ": " + json.error().what);
}

Result<Camera> cameraFromJson(
  const nlohmann::json& object, const std::string& where, const JSONText* text)
{
  if (!object.is_object())
  {
    return makeError(Error::Kind::BadFormat, where + ": a camera is a JSON object");
  }
  Camera camera;
  if (!readVector(object, "position", camera.position))
  {
    return badKey(object, where, text, "position", "three numbers of at most 1e15");
  }
  if (!readVector(object, "focal_point", camera.focalPoint))
  {
    return badKey(object, where, text, "focal_point", "three numbers of at most 1e15");
  }
  if (!readVector(object, "view_up", camera.viewUp))
  {
    return badKey(object, where, text, "view_up", "three numbers of at most 1e15");
  }
  std::optional<double> angle;
  if (!readPositive(object, "view_angle", angle) || (angle && *angle >= 180.0))
  {
    return badKey(object, where, text, "view_angle", "degrees between 0 and 180");
  }
  if (!readPositive(object, "parallel_scale", camera.parallelScale))
  {
    return badKey(object, where, text, "parallel_scale", "a positive number of at most 1e15");
  }
  camera.viewAngleDegrees = angle.value_or(camera.viewAngleDegrees);
  const glm::dvec3 sight = camera.focalPoint - camera.position;
  if (!(glm::length(glm::cross(sight, camera.viewUp)) >
        1.0e-9 * glm::length(sight) * glm::length(camera.viewUp)))
  {
    return makeError(Error::Kind::BadFormat,
      where + ": " + (text ? text->lineOf(object.at("view_up")) : std::string()) +
        "\"view_up\" must not be parallel to the direction of sight, nor any of them zero");
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
