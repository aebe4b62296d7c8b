#include "SplatComposition.h"

#include "ComposeFSGLSL.h"
#include "HighlightGLSL.h"
#include "PictureVSGLSL.h"

#include "OpenGLFunctions.h"

#include <vtkOpenGLFramebufferObject.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkOpenGLState.h>
#include <vtkShaderProgram.h>
#include <vtkTextureObject.h>

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{

enum class Step
{
  Blend,
  Lens,
  Tints,
  RowsOfRim,
  Rim
};

std::string fragmentOf(Step step, std::size_t count, bool ids)
{
  std::string source = ComposeFSGLSL;
  std::string declared, read;
  for (std::size_t i = 0; step == Step::Blend && i < count; ++i)
  {
    const std::string n = std::to_string(i);
    declared += "uniform sampler2D groupColours" + n + ", groupDepths" + n + ";\n";
    read += "colours[" + n + "] = texelFetch(groupColours" + n + ", at, 0);\n";
    read += "depths[" + n + "] = texelFetch(groupDepths" + n + ", at, 0).rg;\n";
    declared += ids ? "uniform sampler2D groupIds" + n + ";\n" : std::string();
    read += "ids[" + n +
      "] = " + (ids ? "texelFetch(groupIds" + n + ", at, 0).xy;\n" : std::string("vec2(0.0);\n"));
  }
  vtkShaderProgram::Substitute(source, "//POINTFRONT::Define::Dec",
    "#define POINTFRONT_STEP " + std::to_string(static_cast<int>(step)) +
      "\n#define POINTFRONT_COUNT " + std::to_string(count) + "\n#define POINTFRONT_IDS " +
      (ids ? "1\n" : "0\n"));
  vtkShaderProgram::Substitute(source, "//POINTFRONT::Groups::Dec", declared);
  vtkShaderProgram::Substitute(source, "//POINTFRONT::Groups::Impl", read);
  vtkShaderProgram::Substitute(
    source, "//POINTFRONT::Highlight::Dec", step >= Step::Tints ? HighlightGLSL : "");
  return source;
}

void prepare(vtkTextureObject* texture, vtkOpenGLRenderWindow* window)
{
  texture->SetContext(window);
  texture->SetMinificationFilter(vtkTextureObject::Nearest);
  texture->SetMagnificationFilter(vtkTextureObject::Nearest);
  texture->SetWrapS(vtkTextureObject::ClampToEdge);
  texture->SetWrapT(vtkTextureObject::ClampToEdge);
}

} // namespace

SplatComposition::SplatComposition() = default;
SplatComposition::~SplatComposition() = default;

bool SplatComposition::begin(vtkOpenGLRenderWindow* window, int width, int height, bool ids)
{
  if (window_ == window && width_ == width && height_ == height && ids_ == ids)
  {
    return true;
  }
  release(window);
  vtkOpenGLState* const state = window->GetState();
  state->PushFramebufferBindings();
  bool whole = true;
  for (Target& target : targets_)
  {
    const auto allocate = [&](vtkTextureObject* texture, int components, int type)
    {
      prepare(texture, window);
      texture->Allocate2D(
        static_cast<unsigned int>(width), static_cast<unsigned int>(height), components, type);
    };
    allocate(target.colours, 4, VTK_UNSIGNED_CHAR);
    allocate(target.depths, 2, VTK_FLOAT);
    target.framebuffer->SetContext(window);
    target.framebuffer->Bind();
    target.framebuffer->AddColorAttachment(0, target.colours);
    target.framebuffer->AddColorAttachment(1, target.depths);
    if (ids)
    {
      allocate(target.ids, 2, VTK_FLOAT);
      target.framebuffer->AddColorAttachment(2, target.ids);
    }
    whole = whole && target.framebuffer->CheckFrameBufferStatus(GL_FRAMEBUFFER) != 0;
  }
  state->PopFramebufferBindings();
  window_ = window;
  width_ = width;
  height_ = height;
  ids_ = ids;
  if (!whole)
  {
    release(window);
  }
  return whole;
}

SplatComposition::Target& SplatComposition::next(const std::vector<Input>& inputs)
{
  const auto isRead = [&](const Target& target)
  {
    return std::any_of(inputs.begin(), inputs.end(),
      [&](const Input& input)
      {
        return input.texture == target.colours.GetPointer() ||
          input.texture == target.depths.GetPointer();
      });
  };
  return *std::find_if(
    targets_.begin(), targets_.end(), [&](const Target& target) { return !isRead(target); });
}

template <typename SetUniforms>
SplatTextures SplatComposition::draw(const std::string& fragment, std::vector<Input> inputs,
  const SplatTextures& base, const SetUniforms& setUniforms)
{
  inputs.push_back({ "baseColours", base.colours });
  inputs.push_back({ "baseDepths", base.depths });
  inputs.push_back({ "baseIds", base.ids });
  Target& target = next(inputs);
  vtkShaderProgram* const program =
    window_->GetShaderCache()->ReadyShaderProgram(PictureVSGLSL, fragment.c_str(), "");
  if (!program)
  {
    return base; // VTK has told why
  }
  target.framebuffer->Bind();
  constexpr GLenum all[] = { GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1, GL_COLOR_ATTACHMENT2 };
  glDrawBuffers(ids_ ? 3 : 2, all);
  for (const Input& input : inputs)
  {
    if (input.texture && program->IsUniformUsed(input.name))
    {
      input.texture->Activate();
      program->SetUniformi(input.name, input.texture->GetTextureUnit());
    }
  }
  setUniforms(program);
  const float edges[4] = { -1.0f, -1.0f, 1.0f, 1.0f };
  program->SetUniform4f("pictureEdges", edges);
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  for (const Input& input : inputs)
  {
    if (input.texture && input.texture->GetTextureUnit() >= 0)
    {
      input.texture->Deactivate();
    }
  }
  return { target.colours, target.depths, ids_ ? target.ids.GetPointer() : nullptr };
}

SplatTextures SplatComposition::blend(
  const SplatTextures& base, const std::vector<Group>& groups, const SplatTextures& untouched)
{
  if (groups.empty())
  {
    return base;
  }
  std::vector<std::string> names;
  std::vector<Input> inputs;
  std::vector<float> opacities;
  names.reserve(3 * groups.size());
  for (std::size_t i = 0; i < groups.size(); ++i)
  {
    const auto name = [&](const char* what)
    {
      names.push_back(what + std::to_string(i));
      return names.back().c_str();
    };
    inputs.push_back({ name("groupColours"), groups[i].picture.colours });
    inputs.push_back({ name("groupDepths"), groups[i].picture.depths });
    inputs.push_back({ name("groupIds"), groups[i].picture.ids });
    opacities.push_back(static_cast<float>(groups[i].opacity));
  }
  inputs.push_back({ "untouched", untouched.colours }); // no shader reads it
  return draw(fragmentOf(Step::Blend, groups.size(), ids_), inputs, base,
    [&](vtkShaderProgram* program)
    { program->SetUniform1fv("opacities", static_cast<int>(opacities.size()), opacities.data()); });
}

SplatTextures SplatComposition::putLens(const SplatTextures& base, const SplatTextures& inside,
  const FrameLens& lens, vtkTextureObject* around)
{
  if (lens.shape == LensShape::Mask && loadedMask_ != lens.mask)
  {
    prepare(mask_, window_);
    mask_->Create2DFromRaw(static_cast<unsigned int>(lens.mask->width),
      static_cast<unsigned int>(lens.mask->height), 1, VTK_UNSIGNED_CHAR,
      const_cast<std::uint8_t*>(lens.mask->values.data()));
    loadedMask_ = lens.mask;
  }
  // A sampler's texture must be there, whether it is looked at or not.
  vtkTextureObject* const mask = lens.shape == LensShape::Mask ? mask_.GetPointer()
    : lens.shape == LensShape::AroundClass                     ? around
                                                               : base.depths;
  const SplatTextures& seen = inside.colours ? inside : base;
  return draw(fragmentOf(Step::Lens, 1, ids_),
    { { "insideColours", seen.colours }, { "insideDepths", seen.depths }, { "insideIds", seen.ids },
      { "lensMask", mask } },
    base,
    [&](vtkShaderProgram* program)
    {
      program->SetUniformi("hasInside", inside.colours ? 1 : 0);
      program->SetUniformi("lensShape", static_cast<int>(lens.shape));
      program->SetUniform2f("lensCentre", &lens.centrePx.x);
      program->SetUniform2f("lensHalfSize", &lens.halfSizePx.x);
      const int size[2] = { width_, height_ };
      program->SetUniform2i("viewportSize", size);
    });
}

SplatTextures SplatComposition::highlight(
  const SplatTextures& base, const std::vector<FrameHighlight>& highlights)
{
  if (highlights.empty())
  {
    return base;
  }
  std::vector<std::array<float, 4>> tints;
  tints.reserve(highlights.size());
  for (const FrameHighlight& one : highlights)
  {
    tints.push_back({ one.colour.r, one.colour.g, one.colour.b, one.tint });
  }
  const auto count = static_cast<int>(tints.size());
  SplatTextures picture = draw(fragmentOf(Step::Tints, tints.size(), ids_), {}, base,
    [&](vtkShaderProgram* program)
    { program->SetUniform4fv("tints", count, reinterpret_cast<float(*)[4]>(tints.data())); });
  for (int number = 0; number < count; ++number)
  {
    const FrameHighlight& one = highlights[static_cast<std::size_t>(number)];
    if (!ids_ && one.haloPx > 0.0f) // a halo is no point
    {
      picture = drawRim(picture, one, number + 1);
    }
  }
  return picture;
}

SplatTextures SplatComposition::drawRim(
  const SplatTextures& base, const FrameHighlight& look, int mark)
{
  const auto setReach = [&](vtkShaderProgram* program)
  {
    program->SetUniformi("mark", mark);
    program->SetUniformi("reach", static_cast<int>(std::ceil(look.haloPx)));
  };
  const SplatTextures rows = draw(fragmentOf(Step::RowsOfRim, 1, false), {}, base, setReach);
  return draw(fragmentOf(Step::Rim, 1, false), { { "acrossMarks", rows.depths } }, base,
    [&](vtkShaderProgram* program)
    {
      setReach(program);
      const float rim[4] = { look.colour.r, look.colour.g, look.colour.b, look.haloPx };
      program->SetUniform4f("rim", rim);
    });
}

void SplatComposition::release(vtkOpenGLRenderWindow* window)
{
  if (!window_ && !loadedMask_)
  {
    return;
  }
  for (Target& target : targets_)
  {
    target.framebuffer->ReleaseGraphicsResources(window);
    target.colours->ReleaseGraphicsResources(window);
    target.depths->ReleaseGraphicsResources(window);
    target.ids->ReleaseGraphicsResources(window);
  }
  mask_->ReleaseGraphicsResources(window);
  loadedMask_ = nullptr;
  window_ = nullptr;
}

} // namespace pointfront
