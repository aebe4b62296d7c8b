#pragma once

#include "TextPanel.h"

#include <vtkNew.h>

#include <chrono>
#include <functional>

class vtkCallbackCommand;
class vtkRenderWindow;

namespace pointfront
{

class MappedStores;

/// Time, points and error of the last frame, over the picture if the user wants to see them.
/// Watches the window's frames.
class FrameFacts
{
public:
  /// `drawn` is called after each frame.
  FrameFacts(vtkRenderWindow* window, vtkRenderer* renderer, const MappedStores& stores,
    std::function<void()> drawn);
  ~FrameFacts();
  FrameFacts(const FrameFacts&) = delete;
  FrameFacts& operator=(const FrameFacts&) = delete;

  void toggle();
  void hide();
  TextPanel& panel() { return panel_; }
  /// The window rests, and the facts that it shows are older than its last frame: it is to be drawn
  /// once more. What that frame takes is no fact.
  bool wantsFrame();

private:
  using Clock = std::chrono::steady_clock;
  void begin();
  void end();
  void write();

  vtkRenderWindow* window_;
  const MappedStores& stores_;
  std::function<void()> drawn_;
  vtkNew<vtkCallbackCommand> command_;
  TextPanel panel_;
  bool shown_ = false;
  bool stale_ = false; ///< a frame was drawn since the text was written
  bool own_ = false; ///< the next frame is drawn for the text
  Clock::time_point begin_;
  double milliseconds_ = 0.0; ///< time of the last frame
};

} // namespace pointfront
