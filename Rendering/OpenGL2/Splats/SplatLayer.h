#pragma once

#include "PixelRectangle.h"
#include "SplatFrame.h"
#include "SplatTarget.h"

class vtkTextureObject;

namespace pointfront
{

/// A layer of a refining view, in a target of its own, over or behind what is seen already.
struct SplatLayer
{
  SeenTextures seen;
  vtkTextureObject* nodes = nullptr; ///< nodes of stand-ins (LayerFS.glsl); null: it is what grows
  bool parallel = false; ///< rays are
};

/// Puts a layer into what is seen, within `limits`: that of one of SplatTools::together then.
/// `parts` of what is seen. False, and nothing changes, where GL has no room or no program for it.
bool putLayer(const SplatFrame& frame, SplatTools& tools, const SplatTarget::Parts& parts,
  const PixelRectangle& limits, const SplatLayer& layer, SeenTextures& seen);

} // namespace pointfront
