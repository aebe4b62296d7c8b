#include "RasterFile.h"

#include "GeoTiffTags.h"
#include "WorldFile.h"

#include "pointfront/Disk/SmallFile.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace pointfront
{
namespace
{
std::optional<ScalarType> scalarTypeOf(const OIIO::TypeDesc& type)
{
  switch (type.basetype)
  {
    case OIIO::TypeDesc::INT8:
      return ScalarType::Int8;
    case OIIO::TypeDesc::UINT8:
      return ScalarType::UInt8;
    case OIIO::TypeDesc::INT16:
      return ScalarType::Int16;
    case OIIO::TypeDesc::UINT16:
      return ScalarType::UInt16;
    case OIIO::TypeDesc::INT32:
      return ScalarType::Int32;
    case OIIO::TypeDesc::UINT32:
      return ScalarType::UInt32;
    case OIIO::TypeDesc::INT64:
      return ScalarType::Int64;
    case OIIO::TypeDesc::UINT64:
      return ScalarType::UInt64;
    case OIIO::TypeDesc::FLOAT:
      return ScalarType::Float32;
    case OIIO::TypeDesc::DOUBLE:
      return ScalarType::Float64;
    default:
      return std::nullopt;
  }
}

Result<void> readPixelLayout(RasterFile& file)
{
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(file.path);
  if (!input)
  {
    return makeError(
      Error::Kind::BadFormat, file.path + ": is no image that can be read: " + OIIO::geterror());
  }
  const OIIO::ImageSpec& spec = input->spec();
  file.width = spec.width;
  file.height = spec.height;
  file.channels = spec.nchannels;
  file.alphaChannel = spec.alpha_channel;
  const std::optional<ScalarType> type = scalarTypeOf(spec.format);
  if (!type || !spec.channelformats.empty() || spec.depth > 1 || file.dataChannels() < 1 ||
    file.dataChannels() > 16)
  {
    return makeError(Error::Kind::Unsupported,
      file.path + ": pixels of " + std::to_string(spec.nchannels) + " channels of " +
        spec.format.c_str() +
        " are not read; 1 to 16 channels of one integer type, float or "
        "double are");
  }
  file.type = *type;
  // OpenImageIO spreads fewer bits over 8 or 16, and inverts them.
  const int ofType = 8 * static_cast<int>(sizeOf(file.type));
  const int bits = spec.get_int_attribute("oiio:BitsPerSample", ofType);
  const bool integers = file.type == ScalarType::UInt8 || file.type == ScalarType::UInt16;
  if (bits < ofType && integers && !file.palette)
  {
    file.spreadBits = bits;
    file.spreadInverted = file.whiteIsZero;
  }
  file.whiteIsZero = file.whiteIsZero && bits == ofType;
  if (file.palette && (file.use == RasterUse::Values || !file.colours.empty()))
  {
    file.channels = 1;
    file.alphaChannel = -1;
    const int indexBits = spec.get_int_attribute("oiio:BitsPerSample", 8);
    file.type = indexBits > 8 ? ScalarType::UInt16 : ScalarType::UInt8;
    if (indexBits != 8 && indexBits != 16)
    {
      return makeError(Error::Kind::Unsupported,
        file.path + ": palettes with " + std::to_string(indexBits) +
          " bits a pixel are not read as indices, nor as colours if one index stands for no data; "
          "8 "
          "and 16 are");
    }
  }
  const bool colour = file.type == ScalarType::UInt8 || file.type == ScalarType::UInt16;
  if (file.use == RasterUse::Colour && !colour)
  {
    return makeError(Error::Kind::Unsupported,
      file.path + ": colours have 8 or 16 bits, this image has " + std::string(nameOf(file.type)) +
        "; --attribute-from NAME=IMG takes its values");
  }
  return {};
}

/// A JPEG that was cut short decodes without complaint: what is missing becomes grey. It lacks its
/// end mark, FF D9, which no other byte but padding follows.
Result<void> checkJpegEnds(const std::string& path)
{
  constexpr std::streamoff tail = 4096;
  std::ifstream file(path, std::ios::binary);
  char head[2] = {};
  file.read(head, sizeof head);
  if (std::string(head, sizeof head) != "\xff\xd8")
  {
    return {};
  }
  file.seekg(0, std::ios::end);
  file.seekg(std::max<std::streamoff>(0, file.tellg() - std::streampos(tail)));
  const std::string end{ std::istreambuf_iterator<char>(file), {} };
  if (end.find("\xff\xd9") == std::string::npos)
  {
    return makeError(
      Error::Kind::Truncated, path + ": this JPEG ends before its end mark; get a whole copy");
  }
  return {};
}

/// From a .prj file beside the image.
void readSystemBeside(RasterFile& file, const CoordinateSystems& systems)
{
  std::filesystem::path beside(file.path);
  beside.replace_extension(".prj");
  const Result<std::string> text = readSmallText(beside.string(), mostDefinitionBytes);
  if (!text)
  {
    return;
  }
  if (Result<CoordinateSystem> system = systems.parse(*text))
  {
    file.system = *system;
  }
  else
  {
    file.systemDoubt = beside.string() + ": " + system.error().what;
  }
}

void readSystem(RasterFile& file, const GeoKeys& keys, const CoordinateSystems& systems)
{
  if (keys.empty())
  {
    return readSystemBeside(file, systems);
  }
  std::vector<std::string> warnings;
  if (Result<CoordinateSystem> system = systems.fromGeoKeys(keys, warnings))
  {
    file.system = *system;
    file.systemDoubt = warnings.empty() ? "" : warnings.front();
    return;
  }
  else
  {
    file.systemDoubt = system.error().what;
  }
  readSystemBeside(file, systems);
}
} // namespace

Bounds RasterFile::ground() const
{
  Bounds bounds;
  for (const glm::dvec2& corner :
    { glm::dvec2(0, 0), glm::dvec2(width, 0), glm::dvec2(0, height), glm::dvec2(width, height) })
  {
    const glm::dvec2 p = transform.toGround(corner);
    bounds.add({ p.x, p.y, 0.0 });
  }
  return bounds;
}

Result<RasterFile> RasterFile::open(
  const std::string& path, RasterUse use, const CoordinateSystems& systems)
{
  RasterFile file;
  file.path = path;
  file.use = use;
  std::error_code failure;
  if (!std::filesystem::is_regular_file(path, failure))
  {
    return makeError(Error::Kind::NotFound, path + ": no such file");
  }
  GeoTiffTags tags;
  if (GeoTiffTags::isTiff(path))
  {
    Result<GeoTiffTags> read = GeoTiffTags::read(path);
    if (!read)
    {
      return read.error();
    }
    tags = std::move(*read);
    file.tiff = true;
  }
  else if (Result<void> whole = checkJpegEnds(path); !whole)
  {
    return whole.error();
  }
  file.palette = tags.palette;
  file.whiteIsZero = tags.whiteIsZero;
  file.noData = tags.noData;
  if (use == RasterUse::Colour && file.noData)
  {
    file.colours = std::move(tags.colours);
  }
  if (Result<void> done = readPixelLayout(file); !done)
  {
    return done.error();
  }
  if (!tags.transform)
  {
    const std::string world = worldFileOf(path);
    if (world.empty())
    {
      return makeError(Error::Kind::Unsupported,
        path + ": is not georeferenced; a GeoTIFF, or a world file beside it, says where it lies");
    }
    Result<GeoTransform> transform = readWorldFile(world);
    if (!transform)
    {
      return transform.error();
    }
    tags.transform = *transform;
  }
  file.transform = *tags.transform;
  readSystem(file, tags.keys, systems);
  return file;
}

} // namespace pointfront
