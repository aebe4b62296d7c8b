#pragma once

#include "pointfront/Style/FrameShading.h"
#include "pointfront/Style/StyleSheet.h"

#include <optional>
#include <vector>

namespace pointfront
{

/// How a mapper's cloud looks in a frame, and which memory it is drawn from. The mapper makes it
/// once, at the beginning of a frame, and passes it on.
struct CloudLook
{
  std::optional<FrameShading> shading; ///< none: the actor's property and the mapper say all
  std::vector<LayerStyling> layers; ///< by number of the store's layer
  /// Every point is drawn with a size of some pixels in one colour, and nothing is done to the
  /// finished picture.
  bool plain = true;
  /// The back end reads the points from host memory: they take no memory of the GPU.
  bool inHostMemory = false;
};

} // namespace pointfront
