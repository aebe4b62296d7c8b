#pragma once

#include "KeyTable.h"

#include <vtkInteractorStyle.h>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace pointfront
{

class ViewCamera;

/// The window, as mouse and keyboard ask it for more than a movement of the camera.
class HandTarget
{
public:
  virtual ~HandTarget() = default;
  /// `pixel`  where the mouse is.
  virtual void obey(KeyAction action, const glm::ivec2& pixel) = 0;
  /// The left button was pressed and let go at one place.
  virtual void click(const glm::ivec2& pixel) = 0;
  /// A key goes down or up; false if nothing happens as long as it is held.
  virtual bool hold(const char* keysym, bool down) = 0;
  /// No key is held any more.
  virtual void letGo() = 0;
  /// The camera makes a single step, as by the wheel: it moves, and rests soon.
  virtual void step() = 0;
  /// Files were dragged into the window.
  virtual void drop(const std::vector<std::string>& files) = 0;
};

/// Mouse and keyboard of the window: keyTable and mouseTable say what they do.
class HandStyle final : public vtkInteractorStyle
{
public:
  static HandStyle* New();
  vtkTypeMacro(HandStyle, vtkInteractorStyle);
  /// Before the first event.
  void connect(ViewCamera* camera, HandTarget* target);

  void OnLeftButtonDown() override;
  void OnLeftButtonUp() override;
  void OnMiddleButtonDown() override;
  void OnMiddleButtonUp() override { this->release(); }
  void OnRightButtonDown() override;
  void OnRightButtonUp() override { this->release(); }
  void OnMouseMove() override;
  void OnMouseWheelForward() override { this->wheel(-1.0); }
  void OnMouseWheelBackward() override { this->wheel(1.0); }
  void OnKeyPress() override;
  void OnKeyRelease() override;
  void OnLeave() override { target_->letGo(); }
  void OnChar() override {} // VTK's own keys
  void OnTimer() override {}
  void OnConfigure() override;
  void OnDropFiles(vtkStringArray* files) override;

protected:
  HandStyle() = default;

private:
  glm::ivec2 mouse() const;
  void press(void (HandStyle::*start)());
  void release();
  void wheel(double steps);

  ViewCamera* camera_ = nullptr;
  HandTarget* target_ = nullptr;
  glm::ivec2 pressed_{ 0 }; ///< where the button was
  glm::ivec2 last_{ 0 };
  glm::dvec3 anchor_{ 0.0 }; ///< the point that was there
  bool dragged_ = false;
};

} // namespace pointfront
