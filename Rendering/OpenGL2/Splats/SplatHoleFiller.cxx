#include "SplatHoleFiller.h"

#include "HolesFSGLSL.h"
#include "LightsGLSL.h"
#include "PictureVSGLSL.h"

#include "HoleFiller.h"
#include "OpenGLFunctions.h"
#include "SplatLights.h"

#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLState.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <algorithm>
#include <string>
#include <vector>

namespace pointfront
{
namespace
{

enum class HolesStep
{
  Begin,
  Gather, ///< to the coarser level
  Fill ///< from the coarser level
};

struct HolesSource
{
  const char* name;
  vtkTextureObject* texture;
};

vtkShaderProgram* useHoles(
  vtkOpenGLRenderWindow* window, HolesStep step, bool blended, bool lit, int looks)
{
  std::string fragment = HolesFSGLSL;
  vtkShaderProgram::Substitute(fragment, "//POINTFRONT::Define::Dec",
    "#define POINTFRONT_STEP " + std::to_string(static_cast<int>(step)) +
      "\n#define POINTFRONT_BLENDED " + (blended ? "1" : "0") + "\n#define POINTFRONT_LIT " +
      (lit ? "1" : "0") + "\n#define POINTFRONT_LOOKS " + std::to_string(looks) + "\n");
  vtkShaderProgram::Substitute(fragment, "//POINTFRONT::Lights::Dec", LightsGLSL);
  return window->GetShaderCache()->ReadyShaderProgram(PictureVSGLSL, fragment.c_str(), "");
}

/// Draws over `place` of the bound framebuffer. `factor`: a level's pixel in pixels of the picture.
void drawLevel(vtkShaderProgram* program, int factor, const float (&agreement)[2],
  const std::vector<HolesSource>& sources)
{
  for (const HolesSource& source : sources)
  {
    source.texture->Activate();
    program->SetUniformi(source.name, source.texture->GetTextureUnit());
  }
  program->SetUniform2f("agreement", agreement);
  program->SetUniformf("levelFactor", static_cast<float>(factor));
  const float edges[4] = { -1.0f, -1.0f, 1.0f, 1.0f };
  program->SetUniform4f("pictureEdges", edges);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  for (const HolesSource& source : sources)
  {
    source.texture->Deactivate();
  }
}

std::vector<HolesSource> sourcesOf(
  const SeenTextures& seen, vtkTextureObject* sums, const SplatTarget::Parts& parts)
{
  std::vector<HolesSource> sources{ { "fineColours", seen.colours },
    { "fineDepths", seen.depths } };
  if (parts.blended)
  {
    sources.push_back({ "colourSums", sums });
  }
  if (parts.lit)
  {
    sources.push_back({ "seenNormals", seen.normals });
  }
  return sources;
}

} // namespace

SplatHoleFiller::SplatHoleFiller() = default;
SplatHoleFiller::~SplatHoleFiller() = default;

bool SplatHoleFiller::allocate(
  vtkOpenGLRenderWindow* window, Level& level, int width, int height, bool looks)
{
  level.width = width;
  level.height = height;
  const auto make = [&](vtkTextureObject* texture, int components, int type)
  {
    texture->SetContext(window);
    texture->SetMinificationFilter(vtkTextureObject::Nearest);
    texture->SetMagnificationFilter(vtkTextureObject::Nearest);
    texture->SetWrapS(vtkTextureObject::ClampToEdge);
    texture->SetWrapT(vtkTextureObject::ClampToEdge);
    texture->Allocate2D(
      static_cast<unsigned int>(width), static_cast<unsigned int>(height), components, type);
  };
  make(level.colours, 4, VTK_UNSIGNED_CHAR);
  make(level.depths, looks ? 4 : 2, VTK_FLOAT);
  level.framebuffer->SetContext(window);
  level.framebuffer->Bind();
  level.framebuffer->AddColorAttachment(0, level.colours);
  level.framebuffer->AddColorAttachment(1, level.depths);
  return level.framebuffer->CheckFrameBufferStatus(GL_FRAMEBUFFER) != 0;
}

bool SplatHoleFiller::prepare(vtkOpenGLRenderWindow* window, int width, int height, bool looks)
{
  if (gathered_[0].width == width && gathered_[0].height == height && looks_ == looks)
  {
    return true;
  }
  release(window);
  looks_ = looks;
  window->GetState()->PushFramebufferBindings();
  bool whole = true;
  for (std::size_t level = 0; level < gathered_.size(); ++level)
  {
    whole = whole && allocate(window, gathered_[level], width, height, looks);
    if (level < filled_.size())
    {
      whole = whole && allocate(window, filled_[level], width, height, looks);
    }
    width = (width + 1) / 2;
    height = (height + 1) / 2;
  }
  window->GetState()->PopFramebufferBindings();
  if (!whole)
  {
    release(window);
  }
  return whole;
}

/// Light looks at pixels beside what is filled: nothing of an earlier frame is there.
void SplatHoleFiller::clear(vtkOpenGLState* state)
{
  filled_[0].framebuffer->Bind();
  constexpr GLenum both[] = { GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1 };
  glDrawBuffers(2, both);
  state->vtkglDisable(GL_SCISSOR_TEST);
  constexpr float zeros[4] = {};
  glClearBufferfv(GL_COLOR, 0, zeros);
  glClearBufferfv(GL_COLOR, 1, zeros);
  state->vtkglEnable(GL_SCISSOR_TEST);
}

bool SplatHoleFiller::fill(vtkOpenGLRenderWindow* window, const SeenTextures& seen,
  vtkTextureObject* sums, const SplatTarget::Parts& parts, const FramePlan& plan,
  const PixelRectangle& place)
{
  const FrameCamera& camera = plan.camera;
  if (!prepare(window, camera.width, camera.height, parts.looks))
  {
    return false;
  }
  const double scale = 0.5 * camera.height * camera.viewToClip[1][1];
  const auto size = static_cast<float>(holeFillerAgreePx / scale);
  const float agreement[2] = { camera.parallel ? 0.0f : size, camera.parallel ? size : 0.0f };
  vtkOpenGLState* const state = window->GetState();
  if (!place.contains({ 0, 0, camera.width, camera.height }))
  {
    clear(state);
  }
  const auto draw =
    [&](HolesStep step, std::size_t number, Level& into, const std::vector<HolesSource>& sources)
  {
    const bool first = step == HolesStep::Begin;
    vtkShaderProgram* const program =
      useHoles(window, step, first && parts.blended, first && parts.lit, looksOf(plan.shading));
    if (!program)
    {
      return; // VTK has told why
    }
    if (first && parts.lit)
    {
      program->SetUniformf("depthShift", depthShiftOf(camera));
      setLooks(program, plan.shading);
      setLights(program, plan);
    }
    into.framebuffer->Bind();
    constexpr GLenum both[] = { GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1 };
    glDrawBuffers(2, both);
    state->vtkglViewport(0, 0, into.width, into.height);
    const int block = 1 << number;
    state->vtkglScissor(place.left / block, place.bottom / block,
      (place.right + block - 1) / block - place.left / block,
      (place.top + block - 1) / block - place.bottom / block);
    drawLevel(program, block, agreement, sources);
  };
  draw(HolesStep::Begin, 0, gathered_[0], sourcesOf(seen, sums, parts));
  for (std::size_t level = 1; level <= levels; ++level)
  {
    draw(HolesStep::Gather, level, gathered_[level],
      { { "fineColours", gathered_[level - 1].colours },
        { "fineDepths", gathered_[level - 1].depths } });
  }
  for (std::size_t level = levels; level-- > 0;)
  {
    Level& coarse = level + 1 == levels ? gathered_[levels] : filled_[level + 1];
    draw(HolesStep::Fill, level, filled_[level],
      { { "fineColours", gathered_[level].colours }, { "fineDepths", gathered_[level].depths },
        { "coarseColours", coarse.colours }, { "coarseDepths", coarse.depths } });
  }
  state->vtkglViewport(0, 0, camera.width, camera.height);
  return true;
}

void SplatHoleFiller::release(vtkOpenGLRenderWindow* window)
{
  const auto free = [window](Level& level)
  {
    level.framebuffer->ReleaseGraphicsResources(window);
    level.colours->ReleaseGraphicsResources(window);
    level.depths->ReleaseGraphicsResources(window);
    level.width = 0;
    level.height = 0;
  };
  std::for_each(gathered_.begin(), gathered_.end(), free);
  std::for_each(filled_.begin(), filled_.end(), free);
}

} // namespace pointfront
