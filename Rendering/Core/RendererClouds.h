#pragma once

class vtkRenderer;

namespace pointfront
{

/// Whether the renderer shows more than one actor (visible, also within assemblies) whose mapper is
/// a vtkPointFrontMapper. Splats of these then meet as those of one cloud do
/// (FrameSetting::composited).
/// Threads  the renderer's, while it draws.
bool hasSeveralClouds(vtkRenderer* renderer);

} // namespace pointfront
