#include "RasterModule.h"

#include "InputFiles.h"

#include "pointfront/Disk/ByteOpeners.h"

#include <algorithm>
#include <dlfcn.h>

namespace pointfront
{
namespace
{
const std::vector<std::string> imageExtensions{ "tif", "tiff", "jpg", "jpeg", "png", "jp2", "bmp" };

Result<void> append(const std::string& argument, std::vector<std::string>& paths)
{
  Result<InputFileList> files = findInputFiles({ argument }, imageExtensions);
  if (!files)
  {
    return files.error();
  }
  for (const std::string& path : files->paths)
  {
    if (std::find(paths.begin(), paths.end(), path) == paths.end())
    {
      paths.push_back(path);
    }
  }
  return {};
}

RasterInput& inputOf(std::vector<RasterInput>& inputs, const std::string& attribute)
{
  const auto known = std::find_if(inputs.begin(), inputs.end(),
    [&](const RasterInput& input) { return input.attribute == attribute; });
  if (known != inputs.end())
  {
    return *known;
  }
  inputs.push_back({ attribute, {} });
  return inputs.back();
}

/// Before anything of an argument is told: an address may have a password or a signature.
Result<void> refuseAddress(const std::string& option, const std::string& argument)
{
  const std::string behindName = argument.substr(argument.find('=') + 1); // all of it without '='
  for (const std::string& image : { argument, behindName })
  {
    if (isAddress(image))
    {
      return makeError(Error::Kind::BadArgument,
        option + ": '" + schemeOf(image) +
          "://...' is an address, and images are read from files only; download the image and name "
          "the file");
    }
  }
  return {};
}

bool taken(const std::string& name)
{
  return name == "rgb" || name == "x" || name == "y" || name == "z" || name == "normal";
}
} // namespace

Result<std::vector<RasterInput>> RasterModule::inputs(
  const std::vector<std::string>& colourFrom, const std::vector<std::string>& attributeFrom)
{
  std::vector<RasterInput> inputs;
  for (const std::string& argument : colourFrom)
  {
    if (Result<void> right = refuseAddress("--color-from", argument); !right)
    {
      return right.error();
    }
    if (Result<void> done = append(argument, inputOf(inputs, "rgb").images); !done)
    {
      return done.error();
    }
  }
  std::string attribute;
  for (const std::string& argument : attributeFrom)
  {
    if (Result<void> right = refuseAddress("--attribute-from", argument); !right)
    {
      return right.error();
    }
    const std::size_t equals = argument.find('=');
    if (equals != std::string::npos)
    {
      attribute = argument.substr(0, equals);
    }
    if (attribute.empty() || taken(attribute))
    {
      return makeError(Error::Kind::BadArgument,
        "--attribute-from " + argument + ": " +
          (attribute.empty() ? "name the attribute: NAME=IMG"
                             : "'" + attribute + "' is a name that values cannot have" +
                (attribute == "rgb" ? "; --color-from gives colours" : "")));
    }
    const std::string image = argument.substr(equals == std::string::npos ? 0 : equals + 1);
    if (Result<void> done = append(image, inputOf(inputs, attribute).images); !done)
    {
      return done.error();
    }
  }
  return inputs;
}

Result<std::unique_ptr<AttributePass>> RasterModule::load(
  const std::vector<RasterInput>& inputs, const std::shared_ptr<const CoordinateSystems>& systems)
{
  void* library = ::dlopen(POINTFRONT_RASTER_MODULE, RTLD_NOW | RTLD_LOCAL);
  void* symbol = library != nullptr ? ::dlsym(library, "pointfrontMakeRasterPass") : nullptr;
  if (symbol == nullptr)
  {
    const char* reason = ::dlerror();
    return makeError(Error::Kind::Unsupported,
      std::string("the library that reads images cannot be loaded (builds with "
                  "POINTFRONT_IMAGE_COLOR=OFF, such as pip's wheels, come without it): ") +
        (reason != nullptr ? reason : POINTFRONT_RASTER_MODULE));
  }
  const auto make = reinterpret_cast<decltype(&pointfrontMakeRasterPass)>(symbol);
  return std::unique_ptr<AttributePass>(make(inputs, systems));
}

} // namespace pointfront
