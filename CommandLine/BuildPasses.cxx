#include "BuildPasses.h"

#include "RasterModule.h"
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

  app.add_option("--color-from", colourFrom_,
        "Colours from georeferenced images: files, patterns, folders; the first has right of way")
    ->type_name("IMG...")
    ->expected(1, -1);
  app.add_option("--attribute-from", attributeFrom_, "Values of georeferenced images, likewise")
    ->type_name("NAME=IMG...")
    ->expected(1, -1);

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
  const Result<std::vector<RasterInput>> images =
    RasterModule::inputs(colourFrom_, attributeFrom_);
  if (!images)
  {
    return images.error();
  }
  if (!images->empty())
  {
    Result<std::unique_ptr<AttributePass>> pass =
      RasterModule::load(*images, std::make_shared<ProjCoordinateSystems>());
    if (!pass)
    {
      return pass.error();
    }
    passes.push_back(std::move(*pass));
  }
  return passes;
}

} // namespace pointfront
