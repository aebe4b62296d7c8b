#include "PCDFile.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::size_t mostComponents = 16; // components of an attribute, see Attribute

std::string formatName(PCDEncoding encoding)
{
  switch (encoding)
  {
    case PCDEncoding::Ascii:
      return "PCD ascii";
    case PCDEncoding::Binary:
      return "PCD binary";
    case PCDEncoding::BinaryCompressed:
      break;
  }
  return "PCD binary_compressed";
}

void addElements(PCDFile& file, std::size_t f)
{
  const PCDField& field = file.header.fields[f];
  if (field.isPackedColour())
  {
    // The number is 0xAARRGGBB, and PCD files are little endian.
    const char* const names[3] = { "red", "green", "blue" };
    for (std::size_t k = 0; k < 3; ++k)
    {
      file.fields.push_back({ names[k], ScalarType::UInt8 });
      file.elements.push_back({ f, 2 - k, ScalarType::UInt8 });
    }
    return;
  }
  for (std::size_t k = 0; k < field.count; ++k)
  {
    const std::string index = field.count > 1 ? "[" + std::to_string(k) + "]" : "";
    file.fields.push_back({ field.name + index, field.type });
    file.elements.push_back({ f, k * sizeOf(field.type), field.type });
  }
}
} // namespace

Result<PCDFile> PCDFile::open(const std::string& path)
{
  Result<MemoryMap> map = MemoryMap::open(path);
  if (!map)
  {
    return map.error();
  }
  const std::string_view text(reinterpret_cast<const char*>(map->data()), map->size());
  Result<PCDHeader> header = PCDHeader::parse(text, path);
  if (!header)
  {
    return header.error();
  }
  PCDFile file{ std::move(*map), path, std::move(*header), {}, {}, {}, {} };
  file.format = formatName(file.header.encoding);
  for (std::size_t f = 0; f < file.header.fields.size(); ++f)
  {
    const PCDField& field = file.header.fields[f];
    if (field.isPadding())
    {
      continue;
    }
    if (field.count > mostComponents)
    {
      file.warnings.push_back("The field '" + field.name + "' is left out: it has " +
        std::to_string(field.count) + " elements, more than the " + std::to_string(mostComponents) +
        " that an attribute can have.");
      continue;
    }
    addElements(file, f);
  }
  if (file.header.viewpointDamaged)
  {
    file.warnings.push_back("VIEWPOINT is not seven numbers: where the sensor was is not known.");
  }
  return file;
}

std::vector<ScannerPlace> PCDFile::scanners(const Bounds& positions) const
{
  if (!header.viewpoint)
  {
    return {};
  }
  constexpr double nearby = 10.0; // extents
  const double extent = positions.empty() ? 0.0 : glm::length(positions.size());
  const bool stated = *header.viewpoint != glm::dvec3(0.0);
  if (!stated && !(glm::length(positions.centre()) <= nearby * extent))
  {
    return {};
  }
  return { { 0, *header.viewpoint } };
}

Result<std::uint64_t> PCDFile::countPresent(std::uint64_t present)
{
  const std::uint64_t claimed = header.points;
  if (present < claimed && present < claimed - present)
  {
    return makeError(Error::Kind::Truncated,
      path + ": of the " + std::to_string(claimed) + " points that the header promises, " +
        std::to_string(present) +
        " are there: the header is wrong, or most of the file is lost; get a whole copy");
  }
  if (present < claimed)
  {
    warnings.push_back(std::to_string(claimed - present) + " of " + std::to_string(claimed) +
      " points are missing: the file ends at byte " + std::to_string(map.size()) + ", after " +
      std::to_string(present) + " whole points.");
  }
  return std::min(present, claimed);
}

} // namespace pointfront
