#pragma once

#include "pointfront/Points/AttributePass.h"
#include "pointfront/Points/PassChoice.h"

namespace pointfront
{

/// Adds the passes that give normals and radii of splats, if the choice asks for some.
/// Errors   Unsupported: it does, and this build was made without them.
Result<void> addNormals(const PassChoice& choice, AttributePasses& passes);

} // namespace pointfront
