#include "Flight.h"

#include "CameraMotion.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace pointfront
{

namespace
{
constexpr double shareOfWay = 0.5; // to the focal point, in a second
constexpr double fastFactor = 4.0;
/// With Shift letters are capitals.
constexpr std::array<std::pair<std::string_view, std::size_t>, 10> keys{ { { "w", 0 }, { "W", 0 },
  { "s", 1 }, { "S", 1 }, { "a", 2 }, { "A", 2 }, { "d", 3 }, { "D", 3 }, { "Prior", 4 },
  { "Next", 5 } } };
} // namespace

bool Flight::hold(std::string_view keysym, bool down)
{
  if (keysym == "Shift_L" || keysym == "Shift_R")
  {
    fast_ = down;
    return true;
  }
  const auto found = std::find_if(
    keys.begin(), keys.end(), [keysym](const auto& key) { return key.first == keysym; });
  if (found == keys.end())
  {
    return false;
  }
  held_[found->second] = down;
  return true;
}

bool Flight::flying() const
{
  return std::any_of(held_.begin(), held_.end(), [](bool held) { return held; });
}

Camera Flight::moved(const Camera& camera, double seconds) const
{
  const auto along = [this](std::size_t there, std::size_t back)
  { return static_cast<double>(held_[there]) - static_cast<double>(held_[back]); };
  const double share = shareOfWay * seconds * (fast_ ? fastFactor : 1.0);
  const double way = share * glm::length(camera.focalPoint - camera.position);
  const double forward = along(0, 1);
  if (!camera.parallelScale)
  {
    return flown(camera, way * glm::dvec3(along(3, 2), along(4, 5), forward));
  }
  const double aside = 2.0 * share * *camera.parallelScale;
  Camera moved = flown(camera, aside * glm::dvec3(along(3, 2), along(4, 5), 0.0));
  moved.parallelScale = *camera.parallelScale * std::exp(-share * forward);
  return moved;
}

} // namespace pointfront
