#pragma once

#include "Camera.h"

#include <array>
#include <string_view>

namespace pointfront
{

/// Keys that are held down to fly, and where they carry the eye.
/// Speed  half of the way to the focal point in a second, so that who came near something flies
///        slowly there; four times as fast while Shift is held.
class Flight
{
public:
  /// A key by its X name; false if it is none to fly with.
  bool hold(std::string_view keysym, bool down);
  bool flying() const;
  void stop() { held_ = {}; }
  /// The camera after some seconds. A parallel view has no depth: what would come nearer grows.
  Camera moved(const Camera& camera, double seconds) const;

private:
  std::array<bool, 6> held_{}; ///< forward, back, left, right, up, down
  bool fast_ = false;
};

} // namespace pointfront
