#include "LeftOut.h"

namespace pointfront
{

std::vector<LeftOutFamily> leftOutFamilies()
{
  std::vector<LeftOutFamily> families;
#ifndef POINTFRONT_WITH_NORMALS
  families.push_back({ "normals and radii of splats", "POINTFRONT_NORMALS" });
#endif
#ifndef POINTFRONT_WITH_PCL
  families.push_back({ "normals by PCL", "POINTFRONT_PCL" });
#endif
#ifndef POINTFRONT_WITH_PROJECTION
  families.push_back({ "coordinate reference systems", "POINTFRONT_PROJECTION" });
#endif
#ifndef POINTFRONT_WITH_IMAGE_COLOR
  families.push_back({ "images", "POINTFRONT_IMAGE_COLOR" });
#endif
#ifndef POINTFRONT_WITH_REMOTE
  families.push_back({ "clouds behind addresses", "POINTFRONT_REMOTE" });
#endif
  return families;
}

Error leftOut(const std::string& what, const std::string& option)
{
  return makeError(Error::Kind::Unsupported,
    what + ": this build was made without it; build with -D" + option + "=ON");
}

} // namespace pointfront
