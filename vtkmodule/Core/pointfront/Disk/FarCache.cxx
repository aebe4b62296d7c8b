#include "pointfront/Disk/FarCache.h"

#include "pointfront/Disk/ByteTraffic.h"
#include "pointfront/Disk/FarSegment.h"
#include "pointfront/Disk/FarSettings.h"
#include "pointfront/Threads/ForkHold.h"

#define XXH_INLINE_ALL
#include <xxhash.h>

#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::uint64_t usualLimit = std::uint64_t(4) << 30;
constexpr std::uint64_t tidyEvery = std::uint64_t(32) << 20; ///< bytes written
constexpr std::uint64_t mostNote = 16384;

std::string setting(const char* name)
{
  const char* const value = std::getenv(name);
  return value != nullptr ? value : "";
}

/// 128 bits: two texts never have the same.
std::string nameOf(const std::string& text)
{
  const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
  char name[40];
  std::snprintf(name, sizeof name, "%016llx%016llx", static_cast<unsigned long long>(hash.high64),
    static_cast<unsigned long long>(hash.low64));
  return name;
}

std::string folderOfSettings()
{
  if (const std::string own = setting("POINTFRONT_CACHE"); !own.empty())
  {
    return own == "off" ? std::string() : own;
  }
  if (const std::string all = setting("XDG_CACHE_HOME"); !all.empty() && all.front() == '/')
  {
    return all + "/pointfront";
  }
  std::error_code failure;
  const std::string home = setting("HOME");
  return !home.empty() && std::filesystem::is_directory(home, failure) ? home + "/.cache/pointfront"
                                                                       : std::string();
}

/// The size that the environment names, if it names one.
Result<std::optional<std::uint64_t>> limitOfSettings()
{
  const std::string text = setting("POINTFRONT_CACHE_SIZE");
  if (text.empty())
  {
    return std::optional<std::uint64_t>();
  }
  const Result<std::uint64_t> bytes = cacheBytesOf(text);
  if (!bytes)
  {
    return makeError(bytes.error().kind, "POINTFRONT_CACHE_SIZE: " + bytes.error().what);
  }
  return std::optional<std::uint64_t>(*bytes);
}

std::uint64_t usualLimitIn(const std::string& folder)
{
  std::error_code failure;
  const auto space = std::filesystem::space(folder, failure);
  return failure ? 0 : std::min<std::uint64_t>(usualLimit, space.available / 10);
}

/// A folder for this user alone, since a token may have opened what comes into it; those above it
/// as usual. One that was there stays as it is: others may use it.
bool makePrivate(const std::filesystem::path& named)
{
  const std::filesystem::path folder = named.has_filename() ? named : named.parent_path(); // "a/"
  std::error_code failure;
  if (::mkdir(folder.c_str(), 0700) != 0 && errno == ENOENT && folder.has_parent_path())
  {
    std::filesystem::create_directories(folder.parent_path(), failure);
    ::mkdir(folder.c_str(), 0700);
  }
  return std::filesystem::is_directory(folder, failure);
}

/// bytes: the most that it keeps; none: by the environment.
Result<std::shared_ptr<const FarCache>> cacheIn(
  const std::string& folder, const std::optional<std::uint64_t>& bytes)
{
  const Result<std::optional<std::uint64_t>> said = bytes ? bytes : limitOfSettings();
  if (!said)
  {
    return said.error();
  }
  const std::shared_ptr<const FarCache> none;
  if (folder.empty() || !makePrivate(folder) || ::access(folder.c_str(), R_OK | W_OK | X_OK) != 0)
  {
    return none;
  }
  const std::uint64_t most = *said ? **said : usualLimitIn(folder);
  return most > 0 ? std::make_shared<const FarCache>(folder, most) : none;
}

/// Bytes [offset, offset + size) in parts that lie in one segment each.
template <typename Visit>
bool eachSegment(std::uint64_t offset, std::size_t size, const Visit& visit)
{
  for (std::size_t done = 0; done < size;)
  {
    const std::uint64_t at = offset + done;
    const auto part = static_cast<std::size_t>(
      std::min<std::uint64_t>(size - done, FarSegment::bytes - at % FarSegment::bytes));
    if (!visit(at / FarSegment::bytes, at % FarSegment::bytes, done, part))
    {
      return false;
    }
    done += part;
  }
  return true;
}
} // namespace

ByteTraffic& ByteTraffic::ofProcess()
{
  static ByteTraffic traffic;
  return traffic;
}

std::string FarIdentity::text() const
{
  return place + '\n' + std::to_string(bytes) + '\n' + tag + '\n' + date + '\n';
}

FarIdentity FarIdentity::withoutPromise() const
{
  FarIdentity same = *this;
  same.lastsUntil = 0;
  return same;
}

Result<std::shared_ptr<const FarCache>> FarCache::ofProcess()
{
  const ForkHold hold;
  // Never deleted: sources may outlive static objects.
  static auto* const cache =
    new Result<std::shared_ptr<const FarCache>>(cacheIn(folderOfSettings(), std::nullopt));
  return *cache;
}

Result<std::shared_ptr<const FarCache>> FarCache::of(const FarSettings& settings)
{
  if (!settings.cacheFolder && !settings.cacheBytes)
  {
    return ofProcess();
  }
  const std::string folder = settings.cacheFolder.value_or(folderOfSettings());
  if (folder == "off" || settings.cacheBytes == 0u)
  {
    return std::shared_ptr<const FarCache>();
  }
  const ForkHold hold;
  // Never deleted, as that of the process.
  using Key = std::pair<std::string, std::optional<std::uint64_t>>;
  static auto* const caches = new std::map<Key, std::shared_ptr<const FarCache>>;
  std::shared_ptr<const FarCache>& cache = (*caches)[{ folder, settings.cacheBytes }];
  if (!cache)
  {
    Result<std::shared_ptr<const FarCache>> made = cacheIn(folder, settings.cacheBytes);
    if (!made)
    {
      return made.error();
    }
    cache = std::move(*made);
  }
  if (!cache && settings.cacheFolder && ::access(folder.c_str(), R_OK | W_OK | X_OK) != 0)
  {
    return makeError(Error::Kind::Unwritable,
      "'" + folder + "' cannot be the cache of an address: it is no folder that can be written");
  }
  return cache;
}

bool FarCache::offline()
{
  const std::string value = setting("POINTFRONT_OFFLINE");
  return !value.empty() && value != "0";
}

FarCache::FarCache(std::string folder, std::uint64_t mostBytes)
  : folder_(std::move(folder))
  , mostBytes_(mostBytes)
  , untidied_(tidyEvery) // the first that is written makes room
{
}

std::string FarCache::segmentPath(const FarIdentity& identity, std::uint64_t segment) const
{
  const std::string name = nameOf(identity.text());
  return folder_ + "/segments/" + name.substr(0, 2) + '/' + name + '-' + std::to_string(segment);
}

bool FarCache::read(
  const FarIdentity& identity, std::uint64_t offset, std::size_t size, std::byte* target) const
{
  if (!identity.tells() || size == 0)
  {
    return false;
  }
  const bool all = eachSegment(offset, size,
    [&](std::uint64_t segment, std::uint64_t at, std::size_t done, std::size_t part)
    {
      const FarSegment file(
        segmentPath(identity, segment), identity.text() + std::to_string(segment));
      return file.read(at, part, target + done);
    });
  if (all)
  {
    ByteTraffic::ofProcess().cacheHits += 1;
    ByteTraffic::ofProcess().cacheBytes += size;
  }
  return all;
}

void FarCache::keep(
  const FarIdentity& identity, std::uint64_t offset, const std::byte* data, std::size_t size) const
{
  constexpr std::uint64_t block = FarSegment::blockBytes;
  const std::uint64_t begin = (offset + block - 1) / block * block;
  const std::uint64_t last = offset + size;
  const std::uint64_t end = last == identity.bytes ? last : last / block * block;
  if (!identity.tells() || full_ || begin >= end)
  {
    return;
  }
  const auto whole = static_cast<std::size_t>(end - begin);
  if ((untidied_ += whole) >= std::min(tidyEvery, mostBytes_ / 8))
  {
    tidy();
    untidied_ = 0;
  }
  const std::byte* const first = data + (begin - offset);
  const bool kept = eachSegment(begin, whole,
    [&](std::uint64_t segment, std::uint64_t at, std::size_t done, std::size_t part)
    {
      const std::string path = segmentPath(identity, segment);
      const bool room = makePrivate(folder_ + "/segments") &&
        makePrivate(std::filesystem::path(path).parent_path());
      const FarSegment file(path, identity.text() + std::to_string(segment));
      return room && file.write(at, first + done, part);
    });
  if (!kept)
  {
    full_ = true; // this process goes on without
  }
}

void FarCache::note(const FarIdentity& identity) const
{
  if (!identity.tells() || full_)
  {
    return;
  }
  const std::string path = folder_ + "/places/" + nameOf(identity.place);
  const std::string fresh = path + '.' + std::to_string(::getpid());
  std::error_code failure;
  makePrivate(folder_ + "/places");
  {
    std::ofstream file(fresh, std::ios::binary);
    file << identity.text();
    identity.lastsUntil > 0 ? file << identity.lastsUntil << '\n' : file;
    file.close();
    if (!file)
    {
      std::filesystem::remove(fresh, failure);
      return;
    }
  }
  std::filesystem::rename(fresh, path, failure);
  if (failure)
  {
    std::filesystem::remove(fresh, failure);
  }
}

std::optional<FarIdentity> FarCache::last(const std::string& place) const
{
  std::ifstream file(folder_ + "/places/" + nameOf(place), std::ios::binary);
  std::string text(mostNote, '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(file.gcount()));
  std::istringstream lines(text);
  FarIdentity identity;
  std::string bytes;
  std::getline(lines, identity.place);
  std::getline(lines, bytes);
  std::getline(lines, identity.tag);
  std::getline(lines, identity.date);
  identity.bytes = std::strtoull(bytes.c_str(), nullptr, 10);
  std::string until;
  std::getline(lines, until);
  identity.lastsUntil = std::strtoll(until.c_str(), nullptr, 10);
  const std::string expected = identity.text() + (until.empty() ? "" : until + '\n');
  const bool whole = identity.place == place && expected == text && identity.tells();
  return whole ? std::optional<FarIdentity>(identity) : std::nullopt;
}

} // namespace pointfront
