#pragma once

#include "ViewRequest.h"

#include "pointfront/Base/Result.h"

namespace pointfront
{

/// Shows a window until the user closes it. The only function of its library.
/// Output  each file that the user has written is named on stdout; warnings go to stderr.
/// Errors  of the stores, as StoreScene::open(); Unsupported without an X server.
extern "C" void pointfrontShowWindow(const ViewRequest& request, Result<void>& outcome);

} // namespace pointfront
