#include "WorldFile.h"

#include "pointfront/Base/LetterCase.h"

#include <array>
#include <filesystem>
#include <fstream>
#include <locale>
#include <vector>

namespace pointfront
{

std::string worldFileOf(const std::string& image)
{
  namespace fs = std::filesystem;
  const fs::path path(image);
  std::string extension = path.extension().string();
  std::vector<std::string> candidates;
  if (extension.size() > 2)
  {
    candidates.push_back(std::string{ '.', extension[1], extension.back(), 'w' });
    candidates.push_back(extension + "w");
  }
  candidates.push_back(".wld");
  for (const std::string& candidate : candidates)
  {
    for (const std::string& spelling : { candidate, capitals(candidate) })
    {
      fs::path world = path;
      world.replace_extension(spelling);
      std::error_code failure;
      if (fs::is_regular_file(world, failure))
      {
        return world.string();
      }
    }
  }
  return {};
}

Result<GeoTransform> readWorldFile(const std::string& path)
{
  std::ifstream file(path);
  file.imbue(std::locale::classic());
  std::array<double, 6> n{};
  for (double& number : n)
  {
    if (!(file >> number))
    {
      return makeError(Error::Kind::BadFormat,
        path + ": a world file holds six numbers, one a line; this one does not");
    }
  }
  const auto transform = GeoTransform::fromCentre({ n[4], n[5] }, { n[0], n[1] }, { n[2], n[3] });
  if (!transform)
  {
    return makeError(
      Error::Kind::BadFormat, path + ": the pixels that this world file describes have no area");
  }
  return *transform;
}

} // namespace pointfront
