#pragma once

#include "RasterItems.h"
#include "SplatProgram.h"

class vtkShaderProgram;

namespace pointfront
{

/// Radii by what the item's style says of sizes; `shaped`, `sized`: codes, sizes are on the GPU.
RadiusSource radiusSourceOf(const RasterItem& item, bool shaped, bool sized);

/// Gives a program of splats (SplatVS.glsl, SplatFS.glsl) what it has to know of all points of
/// `item`'s style and passes; `second`: of the second pass.
void setSplatUniforms(
  vtkShaderProgram* program, const RasterItems& items, const RasterItem& item, bool second);

/// The factor that makes keys of depths smaller than 1: a power of two, so that none
/// of their digits is lost.
float depthScaleOf(const RasterCamera& camera);

} // namespace pointfront
