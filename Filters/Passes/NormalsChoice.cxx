#include "NormalsChoice.h"

#include "LeftOut.h"
#include "NormalsPass.h"
#include "PCLFit.h"
#include "ScanNormalsPass.h"

namespace pointfront
{
namespace
{
bool ofPlanes(const PassChoice& choice)
{
  return choice.normals == PassChoice::Normals::PCA || choice.normals == PassChoice::Normals::PCL;
}

/// Radii that do not come with the normals.
bool radiiApart(const PassChoice& choice)
{
  return choice.splatRadius && (!ofPlanes(choice) || choice.normalsClasses);
}

std::unique_ptr<AttributePass> normalsPass(const PassChoice& choice)
{
  if (choice.normals == PassChoice::Normals::ScanLine)
  {
    return std::make_unique<ScanNormalsPass>(choice.normalsClasses);
  }
  NormalsOptions options;
  options.classes = choice.normalsClasses;
  options.neighbours = choice.normalsNeighbours;
  options.radius = choice.normalsRadius;
  options.eps = choice.normalsEps;
  options.byPCL = choice.normals == PassChoice::Normals::PCL;
  options.curvature = choice.curvature;
  options.splatRadius = !radiiApart(choice);
  return std::make_unique<NormalsPass>(options);
}
} // namespace

Result<void> addNormals(const PassChoice& choice, AttributePasses& passes)
{
  if (choice.normals == PassChoice::Normals::PCL && !hasPCLFit())
  {
    return leftOut("normals by PCL", "POINTFRONT_PCL");
  }
  if (choice.normals != PassChoice::Normals::None)
  {
    passes.push_back(normalsPass(choice));
  }
  if (radiiApart(choice))
  {
    NormalsOptions options;
    options.normals = false;
    passes.push_back(std::make_unique<NormalsPass>(options));
  }
  return {};
}

} // namespace pointfront
