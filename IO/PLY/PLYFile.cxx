#include "PLYFile.h"

#include <algorithm>
#include <utility>

namespace pointfront
{
namespace
{
std::string formatName(PLYEncoding encoding)
{
  switch (encoding)
  {
    case PLYEncoding::Ascii:
      return "PLY ascii";
    case PLYEncoding::LittleEndian:
      return "PLY binary_little_endian";
    case PLYEncoding::BigEndian:
      break;
  }
  return "PLY binary_big_endian";
}
} // namespace

std::vector<TableField> PLYFile::fields() const
{
  std::vector<TableField> fields;
  for (const PLYProperty& property : pointElement().properties)
  {
    if (!property.listCount)
    {
      fields.push_back({ property.name, property.type });
    }
  }
  return fields;
}

Result<PLYFile> PLYFile::open(const std::string& path)
{
  Result<MemoryMap> map = MemoryMap::open(path);
  if (!map)
  {
    return map.error();
  }
  const std::string_view text(reinterpret_cast<const char*>(map->data()), map->size());
  Result<PLYHeader> header = PLYHeader::parse(text, path);
  if (!header)
  {
    return header.error();
  }
  PLYFile file{ std::move(*map), path, std::move(*header), 0, {}, {} };
  const std::vector<PLYElement>& elements = file.header.elements;
  const auto points = std::find_if(elements.begin(), elements.end(),
    [](const PLYElement& element) { return element.name == "vertex" || element.name == "point"; });
  if (points == elements.end())
  {
    std::string names;
    for (const PLYElement& element : elements)
    {
      names += (names.empty() ? "" : ", ") + element.name;
    }
    return makeError(Error::Kind::Unsupported,
      path + ": the PLY file has no element 'vertex' to take points from; its elements: " +
        (names.empty() ? "none" : names));
  }
  file.points = static_cast<std::size_t>(points - elements.begin());
  file.format = formatName(file.header.encoding);
  for (const PLYProperty& property : points->properties)
  {
    if (property.listCount)
    {
      file.warnings.push_back(
        "The list property '" + property.name + "' of the points is left out.");
    }
  }
  return file;
}

} // namespace pointfront
