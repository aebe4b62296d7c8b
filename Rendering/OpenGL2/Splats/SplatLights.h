#pragma once

#include "pointfront/Plan/FramePlan.h"

#include <cstddef>

class vtkShaderProgram;

namespace pointfront
{

/// Most lights of Lights.glsl: OpenGL 3.2 promises 1024 numbers, and a light has 16.
constexpr std::size_t mostLights = 48;

/// Added to what textures have of depths, to count from the eye's plane.
float depthShiftOf(const FrameCamera& camera);

/// Gives a program with Lights.glsl a frame's lights: at most mostLights.
void setLights(vtkShaderProgram* program, const FramePlan& plan);

} // namespace pointfront
