#pragma once

#include "Camera.h"

#include <string>
#include <vector>

namespace pointfront
{

/// The thing that a camera path is laid around.
struct PathSubject
{
  Bounds bounds;
  double ground = 0.0; ///< a typical z of the points
  double aspect = 1.0; ///< width by height of the picture
};

/// One camera a frame.
using CameraPath = std::vector<Camera>;

/// Once around the whole cloud, looking at its centre from 35 degrees above the horizon.
CameraPath orbitPath(const PathSubject& subject, int frames);
/// From the whole cloud straight to its centre, to 2 % of the distance: each frame nearer by the
/// same factor.
CameraPath zoomPath(const PathSubject& subject, int frames);
/// Over the cloud along its longer side, low above the ground, looking ahead and 20 degrees down.
CameraPath flightPath(const PathSubject& subject, int frames);

/// A file: a list of cameras, each with "frames": how many frames lead from it to the next (of
/// the last one: how many it stays; 1 if not given). Position, focal point, up and angle are
/// interpolated linearly. `frames` > 0 resamples the whole path to that many frames.
Result<CameraPath> readPathFile(const std::string& path, int frames);

} // namespace pointfront
