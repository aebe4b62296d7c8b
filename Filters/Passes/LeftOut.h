#pragma once

#include "pointfront/Base/Result.h"

#include <string>
#include <vector>

namespace pointfront
{

/// A family of passes, or a part of one, that a build may leave out.
struct LeftOutFamily
{
  std::string name; ///< "images"
  std::string option; ///< the CMake option that brings it back: "POINTFRONT_IMAGE_COLOR"
};

/// The families that this library was built without.
std::vector<LeftOutFamily> leftOutFamilies();

/// Unsupported: `what` needs a family that this build leaves out.
Error leftOut(const std::string& what, const std::string& option);

} // namespace pointfront
