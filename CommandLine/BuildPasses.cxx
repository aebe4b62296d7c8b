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

  normals_.declare(app);
  heights_.declare(app);
  app.parse_complete_callback([this]() { normals_.check(); });
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
  if (std::unique_ptr<AttributePass> pass = normals_.pass())
  {
    passes.push_back(std::move(pass));
  }
  for (std::unique_ptr<AttributePass>& pass : heights_.passes())
  {
    passes.push_back(std::move(pass));
  }
  return passes;
}

} // namespace pointfront
