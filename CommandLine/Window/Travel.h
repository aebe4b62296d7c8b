#pragma once

#include "Flight.h"

#include <chrono>
#include <optional>
#include <string_view>

class vtkRenderWindow;

namespace pointfront
{

class ViewCamera;

/// Movements of the camera that no button of the mouse holds: single steps, and flights. Meanwhile
/// the window's frames take the time of a view in motion.
class Travel
{
public:
  Travel(vtkRenderWindow* window, ViewCamera& camera);

  /// The camera made a single step; it is at rest soon.
  void step();
  /// False if the key is none to fly with.
  bool hold(std::string_view keysym, bool down);
  /// No key is held any more.
  void stop() { flight_.stop(); }
  /// Moves on by the time that has passed; true if a frame is due.
  bool advance();
  /// There will be something to do without a further event.
  bool underway() const { return restDue_ || flight_.flying(); }

private:
  using Clock = std::chrono::steady_clock;
  vtkRenderWindow* window_;
  ViewCamera& camera_;
  Flight flight_;
  Clock::time_point flown_; ///< until then
  std::optional<Clock::time_point> restDue_;
};

} // namespace pointfront
