#include "pointfront/Disk/TemporaryFile.h"

#include <cerrno>
#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <optional>
#include <random>
#include <string_view>
#include <utility>

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace pointfront
{
namespace
{
constexpr std::string_view ending = ".tmp";

Error notMade(const std::string& path, const std::string& why)
{
  return makeError(Error::Kind::Unwritable, "cannot write '" + path + "': " + why);
}

std::string creationAdvice(int error, const std::string& path)
{
  switch (error)
  {
    case ENOENT:
      return "the folder '" + folderOf(path) + "' does not exist; create it first";
    case EACCES:
    case EPERM:
    case EROFS:
      return std::string(std::strerror(error)) + "; choose a folder you may write to";
    case EISDIR:
      return "it is a folder; choose another name";
    default:
      return std::strerror(error);
  }
}

std::string hexadecimal(std::uint64_t number)
{
  char text[17];
  std::snprintf(text, sizeof(text), "%016" PRIx64, number);
  return text;
}

std::uint64_t randomNumber()
{
  std::random_device device; // the operating system's: nobody guesses it
  return std::uint64_t(device()) << 32 | device();
}

/// The mark between the name of the file and the ending.
std::string markOf(ino_t inode, const std::string& random)
{
  return "." + hexadecimal(inode) + "-" + random;
}

/// Whether the entry of a folder is a temporary file of `name`, by its name and its inode number.
bool isTemporary(const std::string& folder, std::string_view entry, std::string_view name)
{
  const std::size_t length = name.size() + markOf(0, hexadecimal(0)).size() + ending.size();
  struct stat state = {};
  if (entry.size() != length || entry.substr(0, name.size()) != name ||
    entry.substr(length - ending.size()) != ending ||
    ::lstat((folder + "/" + std::string(entry)).c_str(), &state) != 0 || !S_ISREG(state.st_mode))
  {
    return false;
  }
  const std::string inode = markOf(state.st_ino, "");
  const std::string_view random = entry.substr(name.size() + inode.size(), 16);
  return entry.substr(name.size(), inode.size()) == inode &&
    random.find_first_not_of("0123456789abcdef") == std::string_view::npos;
}

/// Removes a left-over. False if a living process has it.
bool removeLeftOver(const std::string& path)
{
  const int descriptor = ::open(path.c_str(), O_RDWR | O_NOFOLLOW | O_CLOEXEC);
  if (descriptor < 0)
  {
    return true;
  }
  const bool locked = ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  const bool alive = !locked && errno == EWOULDBLOCK; // otherwise: no locks here
  if (locked)
  {
    ::unlink(path.c_str());
  }
  ::close(descriptor);
  return !alive;
}

/// All but `own`.
bool removeOthers(const std::string& path, const std::string& own)
{
  const std::string folder = folderOf(path);
  DIR* const entries = ::opendir(folder.c_str());
  if (entries == nullptr)
  {
    return true; // a folder may be written to and not be read
  }
  const std::string name = path.substr(path.rfind('/') + 1);
  const std::string ownName = own.substr(own.rfind('/') + 1);
  bool free = true;
  while (const dirent* const entry = ::readdir(entries))
  {
    if (ownName != entry->d_name && isTemporary(folder, entry->d_name, name))
    {
      free = removeLeftOver(folder + "/" + entry->d_name) && free;
    }
  }
  ::closedir(entries);
  return free;
}

/// Renames where nothing has the new name. The errno of a failure.
std::optional<int> renameToFree(const std::string& from, const std::string& to)
{
#ifdef RENAME_NOREPLACE
  if (::renameat2(AT_FDCWD, from.c_str(), AT_FDCWD, to.c_str(), RENAME_NOREPLACE) == 0)
  {
    return std::nullopt;
  }
  if (errno != EINVAL && errno != ENOSYS)
  {
    return errno;
  }
#endif
  // A file system that cannot do that in one step: a link is exclusive too.
  if (::link(from.c_str(), to.c_str()) == 0)
  {
    ::unlink(from.c_str());
    return std::nullopt;
  }
  struct stat there = {};
  if (errno == EEXIST || ::lstat(to.c_str(), &there) == 0)
  {
    return EEXIST;
  }
  return ::rename(from.c_str(), to.c_str()) == 0 ? std::nullopt : std::optional<int>(errno);
}
/// A file that is locked when it gets its name, so that whoever is killed leaves none that nobody
/// takes for a left-over. Nothing where the file system or the kernel cannot do that.
std::optional<TemporaryFile> createUnnamed(const std::string& path, const std::string& random)
{
#ifdef O_TMPFILE
  const int descriptor = ::open(folderOf(path).c_str(), O_RDWR | O_TMPFILE | O_CLOEXEC, 0666);
  if (descriptor < 0)
  {
    return std::nullopt;
  }
  ::flock(descriptor, LOCK_EX | LOCK_NB); // fails only where there are no locks
  struct stat state = {};
  ::fstat(descriptor, &state);
  const std::string named = path + markOf(state.st_ino, random) + std::string(ending);
  const std::string opened = "/proc/self/fd/" + std::to_string(descriptor);
  if (::linkat(AT_FDCWD, opened.c_str(), AT_FDCWD, named.c_str(), AT_SYMLINK_FOLLOW) == 0)
  {
    return TemporaryFile{ named, descriptor };
  }
  ::close(descriptor);
#endif
  return std::nullopt;
}

/// Likewise with a first name, under which a kill between two calls leaves an empty file.
Result<TemporaryFile> createNamed(const std::string& path, const std::string& random)
{
  const std::string first = path + "." + random + std::string(ending);
  int descriptor = -1;
  do
  {
    descriptor = ::open(first.c_str(), O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
  } while (descriptor < 0 && errno == EINTR);
  if (descriptor < 0)
  {
    return notMade(path, creationAdvice(errno, path));
  }
  // The lock comes before the name by which others take the file for a left-over.
  ::flock(descriptor, LOCK_EX | LOCK_NB); // fails only where there are no locks
  struct stat state = {};
  ::fstat(descriptor, &state);
  const std::string named = path + markOf(state.st_ino, random) + std::string(ending);
  if (::rename(first.c_str(), named.c_str()) != 0)
  {
    const int failed = errno;
    ::unlink(first.c_str());
    ::close(descriptor);
    return notMade(path, creationAdvice(failed, path));
  }
  return TemporaryFile{ named, descriptor };
}
} // namespace

std::string folderOf(const std::string& path)
{
  const std::size_t slash = path.rfind('/');
  if (slash == std::string::npos)
  {
    return ".";
  }
  return slash == 0 ? "/" : path.substr(0, slash);
}

Result<TemporaryFile> createTemporaryFile(const std::string& path)
{
  const std::string random = hexadecimal(randomNumber());
  std::optional<TemporaryFile> unnamed = createUnnamed(path, random);
  Result<TemporaryFile> created =
    unnamed ? Result<TemporaryFile>(std::move(*unnamed)) : createNamed(path, random);
  if (created && !removeOthers(path, created->path))
  {
    ::unlink(created->path.c_str());
    ::close(created->descriptor);
    return notMade(path, "another process is writing it now; wait or choose another name");
  }
  return created;
}

bool removeLeftOvers(const std::string& path)
{
  return removeOthers(path, "");
}

Result<void> nameTemporaryFile(const std::string& temporary, const std::string& path, bool replace)
{
  if (replace)
  {
    return ::rename(temporary.c_str(), path.c_str()) == 0
      ? Result<void>()
      : Result<void>(notMade(path, std::strerror(errno)));
  }
  const std::optional<int> failed = renameToFree(temporary, path);
  if (failed == EEXIST)
  {
    return notMade(path,
      "something else has got that name meanwhile, and is kept; choose another name and start "
      "again");
  }
  return failed ? Result<void>(notMade(path, std::strerror(*failed))) : Result<void>();
}

} // namespace pointfront
