#include "pointfront/Tiles/TileFormat.h"

#include "pointfront/Base/FileNames.h"
#include "pointfront/Base/LetterCase.h"
#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Disk/SmallFile.h"
#include "pointfront/Store/PointStore.h"
#include "pointfront/Tiles/TiledCloud.h"

#include <glob.h>

#include <algorithm>
#include <filesystem>
#include <utility>

namespace pointfront
{
namespace
{
namespace fs = std::filesystem;

constexpr const char* listExtension = ".pfronts";
constexpr std::uintmax_t mostListBytes = 64u << 20; ///< a million long names

std::string_view trimmed(std::string_view line)
{
  constexpr const char* blanks = " \t\r";
  const std::size_t first = line.find_first_not_of(blanks);
  return first == std::string_view::npos
    ? std::string_view()
    : line.substr(first, line.find_last_not_of(blanks) - first + 1);
}

std::vector<std::string> matching(const std::string& pattern)
{
  glob_t matches = {};
  std::vector<std::string> found;
  if (::glob(pattern.c_str(), 0, nullptr, &matches) == 0)
  {
    found.assign(matches.gl_pathv, matches.gl_pathv + matches.gl_pathc);
  }
  ::globfree(&matches);
  return found;
}

/// Keeps the first name of each file, and each address once. How many others there were.
std::size_t dropSameFiles(std::vector<std::string>& files)
{
  FileNames seen;
  const std::size_t before = files.size();
  files.erase(std::remove_if(files.begin(), files.end(),
                [&](const std::string& file) { return seen.add(file).has_value(); }),
    files.end());
  return before - files.size();
}
} // namespace

Result<std::vector<std::string>> parseTileList(std::string_view text, const std::string& path)
{
  constexpr std::string_view byteOrderMark = "\xef\xbb\xbf";
  if (text.substr(0, byteOrderMark.size()) == byteOrderMark)
  {
    text.remove_prefix(byteOrderMark.size());
  }
  std::vector<std::string> names;
  for (std::size_t number = 1; !text.empty(); ++number)
  {
    const std::size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = trimmed(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (line.find('\0') != std::string_view::npos)
    {
      return makeError(Error::Kind::BadFormat,
        path + ": line " + std::to_string(number) +
          " is no text; a list of stores has the name of one in each line");
    }
    if (!line.empty() && line.front() != '#')
    {
      names.emplace_back(line);
    }
  }
  if (names.empty())
  {
    return makeError(Error::Kind::BadFormat,
      path + ": names no store; a list of stores has the name of one in each line");
  }
  return names;
}

Result<std::vector<std::string>> readTileList(const std::string& path)
{
  std::error_code failure;
  const Result<std::string> text = readSmallText(path, mostListBytes);
  if (!text)
  {
    return makeError(text.error().kind, text.error().what + " (a list of stores)");
  }
  const Result<std::vector<std::string>> names = parseTileList(*text, path);
  if (!names)
  {
    return names;
  }
  std::vector<std::string> files;
  for (const std::string& name : *names)
  {
    const Result<std::string> at = fileNamedBy(path, name);
    if (!at)
    {
      return at.error();
    }
    const bool pattern = !isAddress(*at) && !fs::exists(*at, failure) &&
      name.find_first_of("*?[") != std::string::npos;
    const std::vector<std::string> found =
      pattern ? matching(*at) : std::vector<std::string>{ *at };
    if (found.empty())
    {
      return makeError(Error::Kind::NotFound, path + ": nothing matches '" + name + "'");
    }
    for (const std::string& each : found)
    {
      if (endsWithoutCase(fileNameOf(each), listExtension))
      {
        return makeError(
          Error::Kind::BadFormat, path + ": names '" + each + "', a list; a list names stores");
      }
      files.push_back(each);
    }
  }
  dropSameFiles(files);
  return files;
}

Result<TileFolder> TileFolder::of(const std::string& folder)
{
  std::vector<std::string> stores;
  std::vector<std::string> indices;
  std::vector<std::string> octrees;
  std::error_code failure;
  fs::recursive_directory_iterator entry(folder, failure);
  for (; !failure && entry != fs::recursive_directory_iterator(); entry.increment(failure))
  {
    std::error_code vanished;
    const std::string path = entry->path().string();
    if (!entry->is_regular_file(vanished))
    {
      continue;
    }
    if (endsWithoutCase(path, ".pfront"))
    {
      if (!endsWithoutCase(path, ".preview.pfront") || !PointStore::looksLikePreview(path))
      {
        stores.push_back(path);
      }
    }
    else if (endsWithoutCase(path, ".pfindex"))
    {
      indices.push_back(path);
    }
    else if (endsWithoutCase(path, ".copc.laz"))
    {
      octrees.push_back(path);
    }
  }
  if (failure)
  {
    return makeError(
      Error::Kind::Unreadable, folder + ": cannot list the folder: " + failure.message());
  }
  TileFolder found;
  if (!stores.empty() && indices.size() + octrees.size() > 0)
  {
    found.warnings.push_back(std::to_string(indices.size() + octrees.size()) +
      " indices and COPC files are left out beside " + std::to_string(stores.size()) +
      " stores, because they may hold the same points.");
  }
  else if (!indices.empty() && !octrees.empty())
  {
    found.warnings.push_back(std::to_string(octrees.size()) + " COPC files are left out beside " +
      std::to_string(indices.size()) + " indices, because they may hold the same points.");
  }
  found.files = !stores.empty() ? std::move(stores)
    : !indices.empty()          ? std::move(indices)
                                : std::move(octrees);
  std::sort(found.files.begin(), found.files.end());
  if (const std::size_t same = dropSameFiles(found.files); same > 0)
  {
    found.warnings.push_back(std::to_string(same) + " of " +
      std::to_string(found.files.size() + same) +
      " names are links to a file that is there under another name: it counts once.");
  }
  return found;
}

bool TileFormat::accepts(const std::string& path) const
{
  std::error_code failure;
  if (endsWithoutCase(fileNameOf(path), listExtension))
  {
    return isAddress(path) || fs::is_regular_file(path, failure);
  }
  if (!fs::is_directory(path, failure) || fs::exists(fs::path(path) / "ept.json", failure))
  {
    return false;
  }
  const Result<TileFolder> found = TileFolder::of(path);
  return found && !found->files.empty();
}

Result<std::shared_ptr<const StoredCloud>> TileFormat::open(const std::string& path) const
{
  if (endsWithoutCase(fileNameOf(path), listExtension))
  {
    const Result<std::vector<std::string>> files = readTileList(path);
    return files ? TiledCloud::open(path, *files) : files.error();
  }
  Result<TileFolder> found = TileFolder::of(path);
  return found ? TiledCloud::open(path, found->files, std::move(found->warnings)) : found.error();
}

} // namespace pointfront
