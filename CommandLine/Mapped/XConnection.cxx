#include "XConnection.h"

#include <X11/XKBlib.h>
#include <X11/Xlib.h>

#include <cstdlib>
#include <string>

namespace pointfront
{

XConnection::~XConnection()
{
  if (display_ != nullptr)
  {
    XCloseDisplay(display_);
  }
}

Result<void> XConnection::open(const std::string& what, const std::string& instead)
{
  const char* const name = std::getenv("DISPLAY");
  const std::string hint = "; " + instead;
  if (name == nullptr || *name == '\0')
  {
    return makeError(
      Error::Kind::Unsupported, what + " needs an X server and DISPLAY is not set" + hint);
  }
  display_ = XOpenDisplay(nullptr);
  if (display_ == nullptr)
  {
    return makeError(
      Error::Kind::Unsupported, std::string("no X server answers at DISPLAY=") + name + hint);
  }
  return {};
}

void forgiveLostWindows()
{
  static const XErrorHandler others = XSetErrorHandler(nullptr);
  XSetErrorHandler([](Display* display, XErrorEvent* event)
    { return event->error_code == BadWindow ? 0 : others(display, event); });
}

void tellHeldKeys(void* display)
{
  XkbSetDetectableAutoRepeat(static_cast<Display*>(display), True, nullptr);
}

} // namespace pointfront
