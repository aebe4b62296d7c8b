#include "pointfront/Preview/PreviewFile.h"

#include "pointfront/Disk/InputFile.h"
#include "pointfront/Disk/TemporaryFile.h"
#include "pointfront/Store/PointStore.h"
#include "pointfront/Store/PreviewRecord.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

namespace pointfront
{
namespace
{
constexpr const char* nextEnding = ".next";

Error inTheWay(const std::string& path, const char* why)
{
  return makeError(Error::Kind::Unwritable, "cannot write the preview '" + path + "': " + why);
}
} // namespace

PreviewFile::PreviewFile(std::string path)
  : path_(std::move(path))
  , nextPath_(path_ + nextEnding)
{
}

Result<std::unique_ptr<PreviewFile>> PreviewFile::claim(const std::string& storePath)
{
  const std::string path = previewPathOf(storePath);
  const Result<std::unique_ptr<const InputFile>> earlier = InputFile::open(path);
  if (!earlier && earlier.error().kind != Error::Kind::NotFound)
  {
    return inTheWay(path, "something else has that name; rename it");
  }
  if (earlier && (*earlier)->isLocked())
  {
    return inTheWay(path, "another build of that store is running; wait or choose another name");
  }
  if (earlier && !PointStore::looksLikePreview(path))
  {
    return inTheWay(path, "a file that is no preview has that name; rename it");
  }
  const std::string nextPath = path + nextEnding;
  if (::access(nextPath.c_str(), F_OK) == 0 && !PointStore::looksLikePreview(nextPath))
  {
    return inTheWay(nextPath, "a file that is no preview has that name; rename it");
  }
  if (!removeLeftOvers(nextPath))
  {
    return inTheWay(path, "another build of that store is running; wait or choose another name");
  }
  ::unlink(path.c_str());
  ::unlink(nextPath.c_str());
  return std::unique_ptr<PreviewFile>(new PreviewFile(path));
}

PreviewFile::~PreviewFile()
{
  if (PointStore::looksLikePreview(nextPath_))
  {
    ::unlink(nextPath_.c_str());
  }
  if (locked_ >= 0)
  {
    ::unlink(path_.c_str()); // before the lock goes: nobody takes it for a killed build's
    ::close(locked_);
  }
}

Result<void> PreviewFile::replace()
{
  const int next = ::open(nextPath_.c_str(), O_RDWR | O_CLOEXEC);
  if (next < 0)
  {
    return inTheWay(path_, std::strerror(errno));
  }
  ::flock(next, LOCK_EX | LOCK_NB); // fails only where there are no locks
  if (Result<void> named = nameTemporaryFile(nextPath_, path_, locked_ >= 0); !named)
  {
    ::close(next);
    return named;
  }
  if (locked_ >= 0)
  {
    ::close(locked_);
  }
  locked_ = next;
  return {};
}

} // namespace pointfront
