#pragma once

#include "pointfront/Base/Result.h"

#include <string>

struct _XDisplay; // NOLINT(bugprone-reserved-identifier): of Xlib, whose macros stay out of here

namespace pointfront
{

/// A connection of our own to the X server. VTK ends the process when its window finds none, so it
/// is asked before; and it stays open as long as the window, because a server without -noreset
/// begins anew when its last client goes, and refuses others meanwhile.
class XConnection
{
public:
  XConnection() = default;
  ~XConnection();
  XConnection(const XConnection&) = delete;
  XConnection& operator=(const XConnection&) = delete;

  /// Errors  Unsupported: `what` needs a server and there is none, and what to do instead.
  Result<void> open(const std::string& what, const std::string& instead);

private:
  _XDisplay* display_ = nullptr;
};

/// A request about a window that has just gone is no reason to end the process, as Xlib would:
/// while a window closes VTK asks where the mouse is in it.
void forgiveLostWindows();

/// A key that is held sends presses and no releases to the owner of that connection, as it does
/// where there is no X.
void tellHeldKeys(void* display);

} // namespace pointfront
