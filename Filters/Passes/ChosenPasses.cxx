#include "ChosenPasses.h"

#include "HeightAboveGroundPass.h"
#include "KnownSystems.h"
#include "LocalHeightPass.h"
#include "NormalsChoice.h"
#include "RasterModule.h"

#include "pointfront/Base/NumberText.h"

#include <string>

namespace pointfront
{
namespace
{
Error wrong(const std::string& what)
{
  return makeError(Error::Kind::BadArgument, what);
}

Result<void> within(double value, double least, double most, const char* name)
{
  if (value >= least && value <= most) // false for what is no number
  {
    return {};
  }
  return wrong(std::string(name) + " of " + numberText(value, 6) + " is not possible; choose " +
    numberText(least, 6) + " to " + numberText(most, 6));
}

Result<void> checkNormals(const PassChoice& choice)
{
  const PassChoice usual;
  const bool radius = choice.normalsRadius != usual.normalsRadius;
  const bool neighbours = choice.normalsNeighbours != usual.normalsNeighbours;
  const bool eps = choice.normalsEps != usual.normalsEps;
  const bool ofPlanes =
    choice.normals == PassChoice::Normals::PCA || choice.normals == PassChoice::Normals::PCL;
  if (!ofPlanes && (radius || neighbours || eps || choice.curvature))
  {
    return wrong("neighbours, radius, search error and curvature are of normals by PCA or PCL, "
                 "which are not asked for");
  }
  if (choice.normals == PassChoice::Normals::None && choice.normalsClasses)
  {
    return wrong("classes are named that get normals, but no normals are asked for");
  }
  if (radius && neighbours)
  {
    return wrong("normals are from a number of neighbours or from those within a radius, not both");
  }
  Result<void> sound = within(choice.normalsNeighbours, 3, 4096, "a number of neighbours");
  sound = sound ? within(choice.normalsRadius, 0.0, 1e9, "a radius of normals") : sound;
  return sound ? within(choice.normalsEps, 0.0, 1000.0, "a search error") : sound;
}

Result<void> check(const PassChoice& choice)
{
  Result<void> sound = checkNormals(choice); // lengths: cells of positions up to 1e12 have numbers
  sound = sound ? within(choice.localHeightRadius, 1e-3, 1e6, "a radius of heights") : sound;
  return sound ? within(choice.groundCell, 1e-3, 1e6, "a cell of ground") : sound;
}
} // namespace

Result<AttributePasses> chosenPasses(const PassChoice& choice)
{
  if (Result<void> sound = check(choice); !sound)
  {
    return sound.error();
  }
  AttributePasses passes;
  Result<std::unique_ptr<AttributePass>> oneSystem = oneSystemPass(choice);
  if (!oneSystem)
  {
    return oneSystem.error();
  }
  passes.push_back(std::move(*oneSystem));
  const Result<std::vector<RasterInput>> images =
    RasterModule::inputs(choice.colourFrom, choice.attributeFrom);
  if (!images)
  {
    return images.error();
  }
  if (!images->empty())
  {
    Result<std::unique_ptr<AttributePass>> pass = RasterModule::load(*images, knownSystems());
    if (!pass)
    {
      return pass.error();
    }
    passes.push_back(std::move(*pass));
  }
  if (Result<void> added = addNormals(choice, passes); !added)
  {
    return added.error();
  }
  if (choice.localHeight)
  {
    passes.push_back(std::make_unique<LocalHeightPass>(choice.localHeightRadius));
  }
  if (choice.heightAboveGround)
  {
    GroundOptions options;
    options.cell = choice.groundCell;
    options.classified = choice.groundClassified;
    passes.push_back(std::make_unique<HeightAboveGroundPass>(options));
  }
  return passes;
}

Result<void> checkImages(const PassChoice& choice)
{
  const Result<std::vector<RasterInput>> images =
    RasterModule::inputs(choice.colourFrom, choice.attributeFrom);
  return images ? Result<void>() : Result<void>(images.error());
}

} // namespace pointfront
