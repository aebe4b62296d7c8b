#pragma once

#include "pointfront/Plan/FramePlan.h"

#include <cstddef>

class vtkShaderProgram;

namespace pointfront
{

/// Most lights of Lights.glsl: OpenGL 3.2 promises 1024 numbers, and a light has 16.
constexpr std::size_t mostLights = 48;

/// Most looks of a frame (FrameShading::look()), beside that many lights.
constexpr std::size_t mostLooks = 32;

/// Added to what textures have of depths, to count from the eye's plane.
float depthShiftOf(const FrameCamera& camera);

/// POINTFRONT_LOOKS of a program with Lights.glsl.
int looksOf(const FrameShading& shading);
/// Gives such a program a frame's looks: at most mostLooks.
void setLooks(vtkShaderProgram* program, const FrameShading& shading);
/// Gives a program with Lights.glsl a frame's lights: at most mostLights.
void setLights(vtkShaderProgram* program, const FramePlan& plan);

} // namespace pointfront
