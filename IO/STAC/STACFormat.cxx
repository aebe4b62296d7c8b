#include "STACFormat.h"

#include "ItemCollection.h"

#include "pointfront/Base/FileNames.h"
#include "pointfront/Base/LetterCase.h"
#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Disk/SmallFile.h"
#include "pointfront/Tiles/ListedCloud.h"
#include "pointfront/Tiles/TiledCloud.h"

#include <algorithm>
#include <filesystem>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::size_t beginningBytes = std::size_t(64) << 10;

bool isNamedVPC(const std::string& path)
{
  constexpr std::string_view end = ".vpc";
  const std::string name = fileNameOf(path);
  return name.size() > end.size() && endsWithoutCase(name, end);
}
} // namespace

bool STACFormat::accepts(const std::string& path) const
{
  std::error_code failure;
  if (!isAddress(path) && !std::filesystem::is_regular_file(path, failure))
  {
    return false;
  }
  if (isNamedVPC(path))
  {
    return true;
  }
  const std::string first = beginningOf(path, 1);
  if (first.empty() || (first[0] != '{' && !isAsciiSpace(first[0])))
  {
    return false;
  }
  const std::string beginning = beginningOf(path, beginningBytes);
  const auto has = [&beginning](const char* word)
  { return beginning.find(word) != std::string::npos; };
  return beginning[std::min(beginning.find_first_not_of(" \t\r\n"), beginning.size() - 1)] == '{' &&
    has("\"assets\"") &&
    (has("\"features\"") || has("\"FeatureCollection\"") || has("\"Feature\""));
}

Result<std::shared_ptr<const StoredCloud>> STACFormat::open(const std::string& path) const
{
  const Result<std::string> text = readSmallText(path, mostListBytes);
  if (!text)
  {
    return text.error();
  }
  Result<ItemCollection> list = ItemCollection::parse(*text, path);
  if (!list)
  {
    return list.error();
  }
  std::vector<ListedTile> tiles;
  FileNames seen;
  bool told = true; // box and number of each
  for (STACItem& item : list->items)
  {
    const Result<std::string> address = resolvedHref(path, item.href);
    if (!address)
    {
      return address.error();
    }
    if (*address == path)
    {
      return makeError(
        Error::Kind::BadFormat, path + ": item '" + item.name + "' is the list itself");
    }
    const std::string known = publicForm(*address);
    if (!seen.add(known))
    {
      told = told && item.bounds && item.points;
      tiles.push_back({ known, item.bounds.value_or(Bounds()), item.points.value_or(0),
        std::move(item.system), std::move(item.kind) });
    }
  }
  if (told)
  {
    return ListedCloud::open(path, std::move(tiles), std::move(list->warnings));
  }
  std::vector<std::string> addresses;
  for (const ListedTile& tile : tiles)
  {
    addresses.push_back(tile.address);
  }
  return TiledCloud::open(path, addresses, std::move(list->warnings));
}

} // namespace pointfront
