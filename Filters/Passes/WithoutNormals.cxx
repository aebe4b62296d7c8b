#include "NormalsChoice.h"

#include "LeftOut.h"

namespace pointfront
{

Result<void> addNormals(const PassChoice& choice, AttributePasses&)
{
  if (choice.normals != PassChoice::Normals::None)
  {
    return leftOut("normals", "POINTFRONT_NORMALS");
  }
  if (choice.splatRadius)
  {
    return leftOut("radii of splats", "POINTFRONT_NORMALS");
  }
  return {};
}

} // namespace pointfront
