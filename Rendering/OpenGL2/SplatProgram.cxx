#include "SplatProgram.h"

#include "ColourTableGLSL.h"
#include "PictureVSGLSL.h"
#include "ResolveFSGLSL.h"
#include "SplatDataGLSL.h"
#include "SplatFSGLSL.h"
#include "SplatGSGLSL.h"
#include "SplatMembersGLSL.h"
#include "SplatSetUpGLSL.h"
#include "SplatVSGLSL.h"
#include "WallSampleGLSL.h"
#include "WallSetUpGLSL.h"

#include <vtkOpenGLRenderWindow.h>
#include <vtkOpenGLShaderCache.h>
#include <vtkShaderProgram.h>

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
    define("PICKING", variant.ids) + define("QUADS", variant.quads);
}

std::string filled(const char* source, const std::string& defines, bool table, bool walls = false)
{
  std::string result = source;
  const std::pair<const char*, std::string> parts[] = {
    { "//POINTFRONT::Define::Dec", defines },
    { "//POINTFRONT::SplatData::Dec", SplatDataGLSL },
    { "//POINTFRONT::SplatMembers::Dec", SplatMembersGLSL },
    { "//POINTFRONT::ColourTable::Dec", table ? ColourTableGLSL : "" },
    { "//POINTFRONT::SplatSetUp::Dec", SplatSetUpGLSL },
    { "//POINTFRONT::WallSetUp::Dec", walls ? WallSetUpGLSL : "" },
    { "//POINTFRONT::WallSample::Dec", walls ? WallSampleGLSL : "" },
  };
  for (const auto& [mark, text] : parts)
  {
    vtkShaderProgram::Substitute(result, mark, text);
  }
  return result;
}

} // namespace

vtkShaderProgram* SplatPrograms::use(vtkOpenGLRenderWindow* window, const SplatVariant& variant)
{
  auto found = sources_.find(variant);
  if (found == sources_.end())
  {
    const std::string defines = definitions(variant);
    const bool table = variant.colour == PointColouring::Kind::Table ||
      variant.colour == PointColouring::Kind::Elevation;
    Sources sources;
    const bool walls = !variant.square && variant.shape == SplatShape::Wall;
    sources.vertex = filled(SplatVSGLSL, defines, table, walls);
    sources.fragment = filled(SplatFSGLSL, defines, false, walls);
    sources.geometry = variant.quads ? filled(SplatGSGLSL, defines, false) : std::string();
    found = sources_.emplace(variant, std::move(sources)).first;
  }
  const Sources& sources = found->second;
  return window->GetShaderCache()->ReadyShaderProgram(
    sources.vertex.c_str(), sources.fragment.c_str(), sources.geometry.c_str());
}

vtkShaderProgram* SplatPrograms::useResolve(
  vtkOpenGLRenderWindow* window, bool blended, bool lit, bool eyeDome)
{
  const std::string fragment = filled(ResolveFSGLSL,
    define("BLENDED", blended) + define("LIT", lit) + define("EYE_DOME", eyeDome), false);
  return window->GetShaderCache()->ReadyShaderProgram(PictureVSGLSL, fragment.c_str(), "");
}

} // namespace pointfront
