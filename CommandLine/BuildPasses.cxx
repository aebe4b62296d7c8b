#include "BuildPasses.h"

#include "Unavailable.h"

namespace pointfront
{

void BuildPasses::declare(CLI::App& app)
{
  app.add_option("--crs", projection_.target,
        "Coordinate reference system of the store; utm: the zone of the first input (the inputs')")
    ->type_name("EPSG:N|WKTFILE|utm");
  app.add_option("--assume-crs", projection_.assumed, "What inputs are in that do not name it")
    ->type_name("EPSG:N|WKTFILE");

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
  AttributePasses passes;
  passes.push_back(std::make_unique<ProjectionPass>(projection_));
  return passes;
}

} // namespace pointfront
