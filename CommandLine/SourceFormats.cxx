#include "SourceFormats.h"

#include "LASFormat.h"
#include "PLYFormat.h"

#include <algorithm>
#include <cctype>
#include <filesystem>

namespace pointfront
{

SourceFormats::SourceFormats(const SourceOptions& options)
{
  formats_.push_back(std::make_unique<LASFormat>());
  formats_.push_back(std::make_unique<PLYFormat>(options.survey));
}

std::vector<std::string> SourceFormats::extensions() const
{
  std::vector<std::string> all;
  for (const auto& format : formats_)
  {
    const std::vector<std::string> own = format->extensions();
    all.insert(all.end(), own.begin(), own.end());
  }
  return all;
}

Result<std::unique_ptr<PointSource>> SourceFormats::open(const std::string& path) const
{
  std::error_code failure;
  if (!std::filesystem::exists(path, failure))
  {
    return makeError(Error::Kind::NotFound, path + ": no such file");
  }
  for (const auto& format : formats_)
  {
    if (format->accepts(path))
    {
      return format->open(path);
    }
  }
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  std::string known;
  for (const auto& format : formats_)
  {
    const std::vector<std::string> own = format->extensions();
    if (!extension.empty() && std::find(own.begin(), own.end(), extension.substr(1)) != own.end())
    {
      return format->open(path);
    }
    known += (known.empty() ? "" : ", ") + format->name();
  }
  return makeError(Error::Kind::Unsupported,
    path + ": not a point file of a family that is read here (" + known + ")");
}

} // namespace pointfront
