#include "BuildPasses.h"

#include "Unavailable.h"

namespace pointfront
{

void BuildPasses::declare(CLI::App& app)
{
  declareUnavailable(app, "--crs", "coordinates are not transformed");
  declareUnavailable(app, "--assume-crs", "coordinates are not transformed");

  declareUnavailable(app, "--color-from", "points are not coloured from images");
  declareUnavailable(app, "--attribute-from", "attributes are not taken from images");

  app.add_option("--normals", normals_, "Estimate normals (none)")
    ->check(availableValues({ "none" }, { "scanline", "pca" }));
  const std::string noNormals = "normals are not estimated";
  for (const char* option :
    { "--normals-k", "--normals-radius", "--normals-eps", "--normals-classes" })
  {
    declareUnavailable(app, option, noNormals);
  }
  declareUnavailableFlag(app, "--local-height", "heights are not computed");
  declareUnavailableFlag(app, "--height-above-ground", "heights are not computed");
}

Result<AttributePasses> BuildPasses::passes() const
{
  return AttributePasses();
}

} // namespace pointfront
