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

} // namespace pointfront
