#include "SplatProgram.h"

#include "CaptureFSGLSL.h"
#include "CaptureGSGLSL.h"
#include "CaptureVSGLSL.h"
#include "ColourMapTextureGLSL.h"
#include "EarlierSplatGLSL.h"
#include "ForgetFSGLSL.h"
#include "KeptPointGLSL.h"
#include "LayerFSGLSL.h"
#include "LightsGLSL.h"
#include "PictureVSGLSL.h"
#include "PointDataGLSL.h"
#include "ResolveFSGLSL.h"
#include "SphereSampleGLSL.h"
#include "SplatDataGLSL.h"
#include "SplatFSGLSL.h"
#include "SplatGSGLSL.h"
#include "SplatMembersGLSL.h"
#include "SplatSetUpGLSL.h"
#include "SplatVSGLSL.h"
#include "StoredPointGLSL.h"
#include "WallSampleGLSL.h"
#include "WallSetUpGLSL.h"

#include <vtkNew.h>
#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkShaderProgram.h>
#include <vtkTransformFeedback.h>

namespace pointfront
{
namespace
{

std::string define(const char* name, int value)
{
  return std::string("#define POINTFRONT_") + name + " " + std::to_string(value) + "\n";
}

std::string definitions(const SplatVariant& variant)
{
  return define("SHAPE", variant.square ? 0 : 1 + static_cast<int>(variant.shape)) +
    define("PARALLEL", variant.parallel) + define("PASS", variant.second ? 2 : 1) +
    define("COLOUR", static_cast<int>(variant.colour)) + define("MARKED", variant.marked) +
    define("SHAPED", variant.shaped) + define("NORMALS", variant.normals) +
    define("RADIUS", static_cast<int>(variant.radius)) + define("LIT", variant.lit) +
    define("PICKING", variant.ids) + define("QUADS", variant.quads) +
    define("STAND_IN", variant.standIn) + define("FOLLOWS", variant.follows);
}

/// The parts of a shader, beside its own text.
struct Content
{
  std::string defines;
  bool table = false; ///< colours by a table
  bool walls = false;
  bool kept = false;
  bool follows = false;
};

std::string filled(const char* source, const Content& content)
{
  std::string result = source;
  const std::pair<const char*, std::string> parts[] = {
    { "//POINTFRONT::Define::Dec", content.defines },
    { "//POINTFRONT::Lights::Dec", LightsGLSL },
    { "//POINTFRONT::SplatData::Dec", SplatDataGLSL },
    { "//POINTFRONT::SplatMembers::Dec", SplatMembersGLSL },
    { "//POINTFRONT::PointData::Dec", PointDataGLSL },
    { "//POINTFRONT::Point::Dec", content.kept ? KeptPointGLSL : StoredPointGLSL },
    { "//POINTFRONT::ColourMapTexture::Dec", content.table ? ColourMapTextureGLSL : "" },
    { "//POINTFRONT::SplatSetUp::Dec", SplatSetUpGLSL },
    { "//POINTFRONT::SphereSample::Dec", SphereSampleGLSL },
    { "//POINTFRONT::WallSetUp::Dec", content.walls ? WallSetUpGLSL : "" },
    { "//POINTFRONT::WallSample::Dec", content.walls ? WallSampleGLSL : "" },
    { "//POINTFRONT::EarlierSplat::Dec", content.follows ? EarlierSplatGLSL : "" },
  };
  for (const auto& [mark, text] : parts)
  {
    vtkShaderProgram::Substitute(result, mark, text);
  }
  return result;
}

} // namespace

const SplatPrograms::Sources& SplatPrograms::sourcesOf(const SplatVariant& variant, bool captures)
{
  const auto found = sources_.find({ variant, captures });
  if (found != sources_.end())
  {
    return found->second;
  }
  Content content;
  content.defines = definitions(variant);
  content.table = variant.colour == PointColouring::Kind::Table ||
    variant.colour == PointColouring::Kind::Elevation;
  content.walls = !variant.square && variant.shape == SplatShape::Wall;
  content.kept = variant.kept;
  content.follows = variant.follows;
  Sources sources;
  if (captures)
  {
    sources = { filled(CaptureVSGLSL, content), CaptureFSGLSL, CaptureGSGLSL };
  }
  else
  {
    sources.vertex = filled(SplatVSGLSL, content);
    sources.fragment = filled(SplatFSGLSL, content);
    sources.geometry = variant.quads ? filled(SplatGSGLSL, content) : std::string();
  }
  return sources_.emplace(std::make_pair(variant, captures), std::move(sources)).first->second;
}

vtkShaderProgram* SplatPrograms::use(vtkOpenGLRenderWindow* window, const SplatVariant& variant)
{
  const Sources& sources = this->sourcesOf(variant, false);
  return window->GetShaderCache()->ReadyShaderProgram(
    sources.vertex.c_str(), sources.fragment.c_str(), sources.geometry.c_str());
}

vtkShaderProgram* SplatPrograms::useCapture(
  vtkOpenGLRenderWindow* window, const SplatVariant& variant)
{
  const Sources& sources = this->sourcesOf(variant, true);
  vtkNew<vtkTransformFeedback> written; // read when the program is linked; roles say nothing here
  for (const char* name :
    { "capturedPlace", "capturedRadius", "capturedColour", "capturedNormal", "capturedId" })
  {
    written->AddVarying(vtkTransformFeedback::Color_RGBA_F, name);
  }
  return window->GetShaderCache()->ReadyShaderProgram(
    sources.vertex.c_str(), sources.fragment.c_str(), sources.geometry.c_str(), written);
}

vtkShaderProgram* SplatPrograms::useResolve(vtkOpenGLRenderWindow* window, const Resolve& variant)
{
  Content content;
  content.defines = define("BLENDED", variant.blended) + define("LIT", variant.lit) +
    define("EYE_DOME", variant.eyeDome) + define("LOOKS", variant.looks);
  const std::string fragment = filled(ResolveFSGLSL, content);
  return window->GetShaderCache()->ReadyShaderProgram(PictureVSGLSL, fragment.c_str(), "");
}

vtkShaderProgram* SplatPrograms::useLayer(
  vtkOpenGLRenderWindow* window, bool standIns, bool parallel, bool lit)
{
  Content content;
  content.defines =
    define("STAND_INS", standIns) + define("PARALLEL", parallel) + define("LIT", lit);
  const std::string fragment = filled(LayerFSGLSL, content);
  return window->GetShaderCache()->ReadyShaderProgram(PictureVSGLSL, fragment.c_str(), "");
}

vtkShaderProgram* SplatPrograms::useForget(vtkOpenGLRenderWindow* window, bool parallel)
{
  Content content;
  content.defines = define("PARALLEL", parallel);
  const std::string fragment = filled(ForgetFSGLSL, content);
  return window->GetShaderCache()->ReadyShaderProgram(PictureVSGLSL, fragment.c_str(), "");
}

} // namespace pointfront
