#include "EPTDescription.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Disk/SmallFile.h"
#include "pointfront/Points/QuantisationGrid.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

namespace pointfront
{
namespace
{
using Json = nlohmann::json;

constexpr std::int64_t mostNodePoints = 1 << 26; // a node has some ten thousand
constexpr std::size_t mostDimensions = 1000;

Error bad(const std::string& path, const std::string& what)
{
  return makeError(Error::Kind::BadFormat, path + ": " + what);
}

std::optional<ScalarType> typeOf(const std::string& kind, std::int64_t bytes)
{
  const bool isSigned = kind == "signed";
  return kind == "float"             ? floatTypeOf(bytes)
    : isSigned || kind == "unsigned" ? integerTypeOf(bytes, isSigned)
                                     : std::nullopt;
}

double numberOf(const Json& object, const char* key, double otherwise)
{
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? found->get<double>() : otherwise;
}

std::string textOf(const Json& object, const char* key)
{
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string();
}

/// True of positions, in integers, whose largest value is no coordinate.
bool reachesTooFar(const EPTDimension& dimension)
{
  const bool position = dimension.name == "X" || dimension.name == "Y" || dimension.name == "Z";
  const bool real = dimension.type == ScalarType::Float32 || dimension.type == ScalarType::Float64;
  const double steps =
    std::ldexp(1.0, 8 * std::min(4, static_cast<int>(sizeOf(dimension.type))) - 1);
  return position && !real &&
    std::abs(dimension.offset) + steps * std::abs(dimension.scale) > farthestCoordinate;
}

Result<std::vector<EPTDimension>> dimensionsOf(const Json& schema, const std::string& path)
{
  if (!schema.is_array() || schema.empty() || schema.size() > mostDimensions)
  {
    return bad(path, "its \"schema\" is no list of dimensions");
  }
  std::vector<EPTDimension> dimensions;
  for (const Json& entry : schema)
  {
    if (!entry.is_object())
    {
      return bad(path, "its \"schema\" is no list of dimensions");
    }
    EPTDimension dimension;
    dimension.name = textOf(entry, "name");
    const auto size =
      static_cast<std::int64_t>(std::clamp(numberOf(entry, "size", 0.0), 0.0, 1000.0));
    const std::optional<ScalarType> type = typeOf(textOf(entry, "type"), size);
    dimension.scale = numberOf(entry, "scale", 1.0);
    dimension.offset = numberOf(entry, "offset", 0.0);
    if (dimension.name.empty() || !type || !(std::abs(dimension.scale) > 0.0) ||
      !std::isfinite(dimension.scale) || !std::isfinite(dimension.offset))
    {
      return bad(
        path, "its dimension '" + dimension.name + "' has no sound name, type, size or scale");
    }
    dimension.type = *type;
    if (reachesTooFar(dimension))
    {
      return bad(path,
        "the scale or offset of its dimension '" + dimension.name +
          "' lets coordinates reach beyond 1e15");
    }
    dimensions.push_back(std::move(dimension));
  }
  return dimensions;
}

Bounds boundsOf(const Json& description, const std::vector<const char*>& keys)
{
  for (const char* key : keys)
  {
    const auto found = description.find(key);
    const bool six = found != description.end() && found->is_array() && found->size() == 6 &&
      std::all_of(found->begin(), found->end(), [](const Json& n) { return n.is_number(); });
    if (six)
    {
      Bounds bounds;
      for (int axis = 0; axis < 3; ++axis)
      {
        const auto a = static_cast<std::size_t>(axis);
        bounds.low[axis] = (*found)[a].get<double>();
        bounds.high[axis] = (*found)[a + 3].get<double>();
      }
      return bounds;
    }
  }
  return {};
}

bool isKey(const std::string& key)
{
  std::size_t numbers = 0;
  std::size_t digits = 0;
  for (const char c : key + "-")
  {
    if (c == '-')
    {
      numbers += digits > 0 && digits < 20 ? 1 : 5;
      digits = 0;
      continue;
    }
    if (c < '0' || c > '9')
    {
      return false;
    }
    ++digits;
  }
  return numbers == 4;
}

} // namespace

std::size_t EPTDescription::recordBytes() const
{
  std::size_t bytes = 0;
  for (const EPTDimension& dimension : dimensions)
  {
    bytes += sizeOf(dimension.type);
  }
  return bytes;
}

std::optional<QuantisationGrid> EPTDescription::grid() const
{
  static const char* const names[3] = { "X", "Y", "Z" };
  QuantisationGrid grid;
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto found = std::find_if(dimensions.begin(), dimensions.end(),
      [&](const EPTDimension& d) { return d.name == names[axis]; });
    if (found == dimensions.end() || found->type == ScalarType::Float32 ||
      found->type == ScalarType::Float64 || found->scale < 0.0)
    {
      return std::nullopt;
    }
    grid.scale[axis] = found->scale;
    grid.offset[axis] = found->offset;
  }
  return grid;
}

Result<EPTDescription> EPTDescription::parse(std::string_view text, const std::string& path)
{
  const Json json = Json::parse(text.begin(), text.end(), nullptr, false);
  if (!json.is_object() || json.find("schema") == json.end())
  {
    return bad(path, "is no description of an Entwine tree (JSON with a \"schema\")");
  }
  EPTDescription description;
  const std::string encoding = textOf(json, "dataType");
  if (encoding != "laszip" && encoding != "binary" && encoding != "zstandard")
  {
    return makeError(Error::Kind::Unsupported,
      path + ": its nodes are of the kind '" + encoding + "', not laszip, binary or zstandard");
  }
  if (const std::string kind = textOf(json, "hierarchyType"); !kind.empty() && kind != "json")
  {
    return makeError(
      Error::Kind::Unsupported, path + ": its hierarchy is of the kind '" + kind + "', not json");
  }
  description.encoding = encoding == "laszip" ? EPTEncoding::Laszip
    : encoding == "binary"                    ? EPTEncoding::Binary
                                              : EPTEncoding::Zstandard;
  Result<std::vector<EPTDimension>> dimensions = dimensionsOf(json["schema"], path);
  if (!dimensions)
  {
    return dimensions.error();
  }
  description.dimensions = std::move(*dimensions);
  description.bounds = boundsOf(json, { "boundsConforming", "bounds" });
  description.cube = boundsOf(json, { "bounds" });
  description.ticks = numberOf(json, "span", numberOf(json, "ticks", 0.0));
  description.points =
    static_cast<std::uint64_t>(std::clamp(numberOf(json, "points", 0.0), 0.0, 1e18));
  description.version = textOf(json, "version");
  if (const auto srs = json.find("srs"); srs != json.end() && srs->is_object())
  {
    description.wkt = textOf(*srs, "wkt");
    const bool projString = description.wkt.rfind("+proj", 0) == 0;
    if (projString && description.wkt.find("+type=crs") == std::string::npos)
    {
      description.wkt += " +type=crs"; // or it names a step of a calculation
    }
    const std::string code = textOf(*srs, "horizontal");
    if (description.wkt.empty() && !code.empty())
    {
      description.wkt = textOf(*srs, "authority") + ":" + code;
    }
  }
  return description;
}

Result<EPTPage> parseEPTPage(std::string_view text, const std::string& path)
{
  const Json json = Json::parse(text.begin(), text.end(), nullptr, false);
  if (!json.is_object())
  {
    return bad(path, "is no page of a hierarchy (JSON of nodes and their points)");
  }
  EPTPage page;
  for (const auto& [key, count] : json.items())
  {
    if (!isKey(key) || !count.is_number_integer() || count.get<std::int64_t>() < -1 ||
      count.get<std::int64_t>() > mostNodePoints)
    {
      return bad(path, "its node '" + key.substr(0, 60) + "' has no sound key or number of points");
    }
    page.emplace(key, count.get<std::int64_t>());
  }
  return page;
}

std::string pathOfEPTPage(const std::string& path, const std::string& key)
{
  return beside(path, "ept-hierarchy/" + key + ".json");
}

namespace
{
/// Its nodes, and the pages that it refers to. The key of a page that was seen before.
std::optional<std::string> addPage(const EPTPage& page, std::map<std::string, std::uint32_t>& nodes,
  std::set<std::string>& seen, std::vector<std::string>& below)
{
  for (const auto& [key, count] : page)
  {
    if (count >= 0)
    {
      nodes[key] = static_cast<std::uint32_t>(count);
    }
    else if (!seen.insert(key).second)
    {
      return key;
    }
    else
    {
      below.push_back(key);
    }
  }
  return std::nullopt;
}
} // namespace

std::vector<Result<EPTPage>> readEPTPages(
  const std::string& eptPath, const std::vector<std::string>& keys)
{
  std::vector<SmallFile> files;
  for (const std::string& key : keys)
  {
    files.push_back({ pathOfEPTPage(eptPath, key), mostEPTPageBytes });
  }
  const ReadStop never{ false };
  const std::vector<Result<RawBytes>> read = readSmallFiles(files, never);
  std::vector<Result<EPTPage>> pages;
  for (std::size_t p = 0; p < read.size(); ++p)
  {
    pages.push_back(read[p]
        ? parseEPTPage(
            std::string_view(reinterpret_cast<const char*>(read[p]->data.get()), read[p]->size),
            files[p].path)
        : Result<EPTPage>(
            makeError(read[p].error().kind, read[p].error().what + "; the tree refers to it")));
  }
  return pages;
}

Result<EPTHierarchy> readEPTHierarchy(
  const std::string& eptPath, EPTDepth depth, std::optional<std::string> first)
{
  std::map<std::string, std::uint32_t> nodes;
  std::set<std::string> seen{ "0-0-0-0" };
  std::vector<std::string> level{ "0-0-0-0" };
  constexpr std::size_t few = 8; // pages that are read with the first: small trees are then whole
  std::size_t rounds = 0;
  const auto enough = [&]
  {
    return depth == EPTDepth::FirstPoints && (rounds > 1 || level.size() > few) &&
      std::any_of(nodes.begin(), nodes.end(), [](const auto& node) { return node.second > 0; });
  };
  while (!level.empty() && !enough())
  {
    std::vector<Result<EPTPage>> pages;
    if (first)
    {
      pages.push_back(parseEPTPage(*std::exchange(first, std::nullopt), pathOfEPTPage(eptPath)));
    }
    else
    {
      pages = readEPTPages(eptPath, level);
    }
    std::vector<std::string> below;
    for (std::size_t p = 0; p < level.size(); ++p)
    {
      if (!pages[p])
      {
        return pages[p].error();
      }
      if (const std::optional<std::string> twice = addPage(*pages[p], nodes, seen, below))
      {
        return bad(
          pathOfEPTPage(eptPath, level[p]), "the page '" + *twice + "' is referred to twice");
      }
    }
    level = std::move(below);
    ++rounds;
  }
  EPTHierarchy found;
  found.pages = std::move(level);
  for (const auto& [key, count] : nodes)
  {
    if (count > 0)
    {
      found.nodes.push_back({ key, count });
    }
  }
  return found;
}

} // namespace pointfront
