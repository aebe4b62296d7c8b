#pragma once

#include "SplatFrame.h"
#include "SplatGroups.h"
#include "SplatTarget.h"

class vtkShaderProgram;
class vtkTextureObject;

namespace pointfront
{

/// The program that draws a group's points as splats; `second`: weights and colours of what is not
/// behind.
SplatVariant variantOf(
  const SplatGroups::Group& group, const SplatTarget::Parts& parts, bool second);

/// Draws runs of a group's points with a program that reads them (StoredPoint.glsl) and is bound;
/// uniforms that only this program has are the caller's.
/// `records`: of the group's slots, on the GPU.
void drawSplatRuns(const SplatFrame& frame, SlotRecords& records, vtkShaderProgram* program,
  const SplatVariant& variant, const SplatGroups::Group& group, const DrawRuns& runs);

/// Gives a program a texture if it uses one of that name.
void setTexture(vtkShaderProgram* program, const char* name, vtkTextureObject* texture);

} // namespace pointfront
