#include "LASFormat.h"
namespace pointfront
{
bool LASFormat::accepts(const std::string&) const { return false; }
Result<std::unique_ptr<PointSource>> LASFormat::open(const std::string& path) const
{
  return makeError(Error::Kind::Unsupported, path);
}
}
