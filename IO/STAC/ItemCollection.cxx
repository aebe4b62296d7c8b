#include "ItemCollection.h"

#include "pointfront/Base/LetterCase.h"
#include "pointfront/Base/PercentCode.h"
#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Points/QuantisationGrid.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

namespace pointfront
{
namespace
{
using Json = nlohmann::json;

constexpr std::uint64_t mostPoints = std::uint64_t(1) << 48; ///< so that sums of a list are exact

Error bad(const std::string& path, const std::string& what)
{
  return makeError(Error::Kind::BadFormat, path + ": " + what);
}

const Json* find(const Json& object, const char* key)
{
  if (!object.is_object())
  {
    return nullptr;
  }
  const auto found = object.find(key);
  return found == object.end() || found->is_null() ? nullptr : &*found;
}

std::string textOf(const Json& object, const char* key)
{
  const Json* const found = find(object, key);
  return found != nullptr && found->is_string() ? found->get<std::string>() : std::string();
}

bool hasRole(const Json& asset, const char* role)
{
  const Json* const roles = find(asset, "roles");
  return roles != nullptr && roles->is_array() &&
    std::any_of(roles->begin(), roles->end(), [role](const Json& one) { return one == role; });
}

/// How likely an asset is the file of points; 0: it is not.
int likelihood(const std::string& key, const Json& asset)
{
  const std::string href = textOf(asset, "href");
  if (href.empty() || hasRole(asset, "overview"))
  {
    return 0;
  }
  const std::string name = lowered(fileNameOf(href));
  const std::string type = lowered(textOf(asset, "type"));
  const bool inPlace = endsWithoutCase(name, ".copc.laz") || name == "ept.json" ||
    endsWithoutCase(name, ".pfront") || endsWithoutCase(name, ".pfindex") ||
    type.find("copc") != std::string::npos;
  const bool points = endsWithoutCase(name, ".laz") || endsWithoutCase(name, ".las");
  const bool data = hasRole(asset, "data") || key == "data" || key == "pointcloud";
  const bool other = endsWithoutCase(name, ".json") || endsWithoutCase(name, ".tif") ||
    endsWithoutCase(name, ".png");
  return inPlace ? 4 + (data ? 1 : 0) : points ? 2 + (data ? 1 : 0) : data && !other ? 1 : 0;
}

/// The asset with the points; null: there is none.
const Json* assetOf(const Json& item)
{
  const Json* const assets = find(item, "assets");
  const Json* best = nullptr;
  int most = 0;
  if (assets != nullptr && assets->is_object())
  {
    for (const auto& [key, asset] : assets->items())
    {
      if (const int likely = likelihood(key, asset); likely > most)
      {
        most = likely;
        best = &asset;
      }
    }
  }
  return best;
}

/// A fact that stands in the item's properties, or in those of its asset.
const Json* fact(const Json& item, const Json& asset, const char* key)
{
  const Json* const properties = find(item, "properties");
  const Json* const found = properties != nullptr ? find(*properties, key) : nullptr;
  return found != nullptr ? found : find(asset, key);
}

/// Lowest and highest elevation of the file's statistics.
std::optional<std::pair<double, double>> elevations(const Json* statistics)
{
  if (statistics == nullptr || !statistics->is_array())
  {
    return std::nullopt;
  }
  for (const Json& of : *statistics)
  {
    const Json* const low = find(of, "minimum");
    const Json* const high = find(of, "maximum");
    if (textOf(of, "name") == "Z" && low != nullptr && high != nullptr && low->is_number() &&
      high->is_number())
    {
      return std::pair(low->get<double>(), high->get<double>());
    }
  }
  return std::nullopt;
}

Result<std::optional<Bounds>> boundsOf(
  const Json& item, const Json& asset, const std::string& where)
{
  const Json* const box = fact(item, asset, "proj:bbox");
  if (box == nullptr)
  {
    return std::optional<Bounds>();
  }
  std::vector<double> numbers;
  for (const Json& one : box->is_array() ? *box : Json::array())
  {
    numbers.push_back(one.is_number() ? one.get<double>() : NAN);
  }
  if (numbers.size() == 4)
  {
    const auto heights = elevations(fact(item, asset, "pc:statistics"));
    if (!heights)
    {
      return std::optional<Bounds>();
    }
    numbers = { numbers[0], numbers[1], heights->first, numbers[2], numbers[3], heights->second };
  }
  const bool numeric = numbers.size() == 6 &&
    std::all_of(numbers.begin(), numbers.end(),
      [](double one) { return std::abs(one) <= farthestCoordinate; });
  Bounds bounds;
  if (numeric)
  {
    bounds = { { numbers[0], numbers[1], numbers[2] }, { numbers[3], numbers[4], numbers[5] } };
  }
  if (bounds.empty())
  {
    return bad(where, "its \"proj:bbox\" is no box of 4 or 6 numbers, lowest first");
  }
  return std::optional<Bounds>(bounds);
}

Result<std::optional<std::uint64_t>> pointsOf(
  const Json& item, const Json& asset, const std::string& where)
{
  const Json* const count = fact(item, asset, "pc:count");
  if (count == nullptr)
  {
    return std::optional<std::uint64_t>();
  }
  const double number = count->is_number() ? count->get<double>() : -1.0;
  if (!(number >= 0.0) || number != std::floor(number) || number > double(mostPoints))
  {
    return bad(where, "its \"pc:count\" is no number of points");
  }
  return std::optional<std::uint64_t>(static_cast<std::uint64_t>(number));
}

std::string systemOf(const Json& item, const Json& asset)
{
  for (const char* key : { "proj:wkt2", "proj:projjson", "proj:code", "proj:epsg" })
  {
    if (const Json* const found = fact(item, asset, key))
    {
      return found->is_string() ? found->get<std::string>()
                                : found->dump(-1, ' ', false, Json::error_handler_t::replace);
    }
  }
  return {};
}

Result<STACItem> itemOf(const Json& item, const Json& asset, const std::string& path)
{
  STACItem made;
  made.name = textOf(item, "id");
  made.href = textOf(asset, "href");
  const std::string where = path + ": item '" + made.name + "'";
  Result<std::optional<Bounds>> bounds = boundsOf(item, asset, where);
  if (!bounds)
  {
    return bounds.error();
  }
  Result<std::optional<std::uint64_t>> points = pointsOf(item, asset, where);
  if (!points)
  {
    return points.error();
  }
  made.bounds = *bounds;
  made.points = *points;
  made.system = systemOf(item, asset);
  if (const Json* const schemas = fact(item, asset, "pc:schemas"))
  {
    made.kind = schemas->dump(-1, ' ', false, Json::error_handler_t::replace);
  }
  return made;
}

/// Whether a search of a server has more items than these.
bool hasNextPage(const Json& json)
{
  const Json* const links = find(json, "links");
  return links != nullptr && links->is_array() &&
    std::any_of(
      links->begin(), links->end(), [](const Json& link) { return textOf(link, "rel") == "next"; });
}

/// A reference with what may not stand in a URI percent-encoded, as browsers do it: blanks, letters
/// beyond ASCII, a '%' that begins no code. The name of a host stays.
std::string uriOf(const std::string& reference)
{
  constexpr std::string_view notInURIs = "\"<>\\^`{|}";
  const std::size_t host = isAddress(reference) ? reference.find("://") + 3
    : reference.compare(0, 2, "//") == 0        ? 2
                                                : 0;
  std::size_t at = host > 0 ? std::min(reference.find('/', host), reference.size()) : 0;
  std::string made = reference.substr(0, at);
  for (; at < reference.size(); ++at)
  {
    const char letter = reference[at];
    const bool fit = letter > 0x20 && letter < 0x7f &&
      notInURIs.find(letter) == std::string_view::npos &&
      (letter != '%' || isPercentCode(reference, at));
    made += fit ? std::string(1, letter) : percentEncoded({ &letter, 1 }, "");
  }
  return made;
}

/// The address that a reference means in the list at an address. It has the query of the list,
/// unless it has its own, and is read with the list's settings. Source  RFC 3986, section 5.2.
Result<std::string> joined(const std::string& list, const std::string& reference)
{
  if (isAddress(reference) || reference.compare(0, 2, "//") == 0)
  {
    const std::string whole = isAddress(reference) ? reference : schemeOf(list) + ':' + reference;
    return fileNamedBy(list, withoutDots(whole));
  }
  const std::size_t query = std::min(list.find_first_of("?#"), list.size());
  const std::size_t host = list.find("://") + 3;
  const std::size_t root = std::min(list.find('/', host), query);
  const std::size_t folder = std::max(list.substr(0, query).rfind('/') + 1, root);
  const bool fromRoot = reference.compare(0, 1, "/") == 0;
  const std::string base =
    list.substr(0, fromRoot ? root : folder) + (fromRoot || folder > root ? "" : "/");
  const std::size_t end = std::min(reference.find_first_of("?#"), reference.size());
  const std::string place = withoutDots(base + reference.substr(0, end));
  return end < reference.size() && reference[end] == '?'
    ? fileNamedBy(list, place + reference.substr(end))
    : place + list.substr(query) + reference.substr(end);
}

/// Most lists write names of files as they are, and some as URIs.
std::string onDisk(const std::string& list, const std::string& name)
{
  std::error_code failure;
  const std::string written = beside(list, name);
  const std::string decoded = beside(list, percentDecoded(name));
  const bool other = !std::filesystem::exists(written, failure) &&
    decoded.find('\0') == std::string::npos && std::filesystem::exists(decoded, failure);
  return other ? decoded : written;
}
} // namespace

Result<ItemCollection> ItemCollection::parse(std::string_view text, const std::string& path)
{
  const Json json = Json::parse(text.begin(), text.end(), nullptr, false);
  const std::string type = textOf(json, "type");
  if (type == "Collection" || type == "Catalog")
  {
    return bad(path,
      "is a STAC " + type +
        ", which names other files of items; an ItemCollection has the items "
        "themselves, such as the answer of a server's search");
  }
  const Json* const features = find(json, "features");
  const bool alone = type == "Feature";
  if (!alone && (type != "FeatureCollection" || features == nullptr || !features->is_array()))
  {
    return bad(path,
      "is no STAC ItemCollection: no JSON object with \"features\" and of the type "
      "\"FeatureCollection\"");
  }
  ItemCollection made;
  std::size_t pointless = 0;
  const Json list = alone ? Json::array({ json }) : Json();
  for (const Json& item : alone ? list : *features)
  {
    const Json* const asset = assetOf(item);
    if (asset == nullptr)
    {
      ++pointless;
      continue;
    }
    Result<STACItem> one = itemOf(item, *asset, path);
    if (!one)
    {
      return one.error();
    }
    made.items.push_back(std::move(*one));
  }
  if (made.items.empty())
  {
    return bad(path,
      "names no file of points: none of its " + std::to_string(pointless) +
        " items has an asset that is one");
  }
  if (pointless > 0)
  {
    made.warnings.push_back(std::to_string(pointless) + " of its " +
      std::to_string(pointless + made.items.size()) +
      " items name no file of points and are left out.");
  }
  if (hasNextPage(json))
  {
    made.warnings.push_back("It is one page of several: the items of the others are not in it.");
  }
  return made;
}

Result<std::string> resolvedHref(const std::string& path, const std::string& href)
{
  constexpr std::string_view file = "file://";
  constexpr std::string_view curl = "/vsicurl/"; // GDAL's and PDAL's way to say it
  std::string name = href.compare(0, curl.size(), curl) == 0 ? href.substr(curl.size()) : href;
  if (Result<void> sound = refuseSettings(path, name); !sound)
  {
    return sound.error();
  }
  if (isAddress(path))
  {
    return joined(path, uriOf(name));
  }
  if (name.compare(0, file.size(), file) == 0)
  {
    name = name.substr(file.size());
  }
  if (isAddress(name))
  {
    return withoutDots(uriOf(name));
  }
  while (name.compare(0, 2, "./") == 0)
  {
    name = name.substr(2);
  }
  return onDisk(path, name);
}

} // namespace pointfront
