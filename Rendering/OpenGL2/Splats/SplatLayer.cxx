#include "SplatLayer.h"

#include "OpenGLFunctions.h"
#include "SplatRuns.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLState.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <utility>

namespace pointfront
{

bool putLayer(const SplatFrame& frame, SplatTools& tools, const SplatTarget::Parts& parts,
  const PixelRectangle& limits, const SplatLayer& layer, SeenTextures& seen)
{
  SplatTarget::Parts both = parts;
  both.ids = both.blended = both.picture = false;
  SplatTarget* const first = &tools.together[0];
  SplatTarget& into = seen.colours == first->seen().colours ? tools.together[1] : *first;
  if (!into.prepare(frame.window, both))
  {
    return false;
  }
  vtkShaderProgram* const program =
    tools.programs.useLayer(frame.window, layer.nodes != nullptr, layer.parallel, parts.lit);
  if (!program)
  {
    return false; // VTK has told why
  }
  vtkOpenGLState* const state = frame.window->GetState();
  state->vtkglDisable(GL_DEPTH_TEST);
  state->vtkglDisable(GL_SCISSOR_TEST);
  state->vtkglDepthMask(GL_TRUE); // all of the target becomes empty
  into.beginSeen(true);
  state->vtkglDepthMask(GL_FALSE);
  state->vtkglEnable(GL_SCISSOR_TEST);
  state->vtkglScissor(limits.left, limits.bottom, limits.width(), limits.height());
  const std::pair<const char*, vtkTextureObject*> textures[] = { { "seenColours", seen.colours },
    { "seenDepths", seen.depths }, { "layerColours", layer.seen.colours },
    { "layerDepths", layer.seen.depths }, { "layerNodes", layer.nodes },
    { "seenNormals", seen.normals }, { "layerNormals", layer.seen.normals } };
  for (const auto& [name, texture] : textures)
  {
    texture ? setTexture(program, name, texture) : void();
  }
  const float edges[4] = { -1.0f, -1.0f, 1.0f, 1.0f };
  program->SetUniform4f("pictureEdges", edges);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  for (const auto& [name, texture] : textures)
  {
    if (texture && texture->GetTextureUnit() >= 0)
    {
      texture->Deactivate();
    }
  }
  seen = into.seen();
  return true;
}

} // namespace pointfront
