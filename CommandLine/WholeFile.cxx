#include "WholeFile.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <unistd.h>

namespace pointfront
{

namespace
{
std::string temporaryName(const std::string& path)
{
  return path + ".tmp" + std::to_string(::getpid());
}

Error unwritable(const std::string& path, int reason)
{
  return makeError(Error::Kind::Unwritable, path + ": cannot be written: " + std::strerror(reason));
}

struct CloseFile
{
  void operator()(std::FILE* file) const { std::fclose(file); }
};
} // namespace

Result<void> writeWholeFile(const std::string& path, const void* bytes, std::size_t size)
{
  const std::string temporary = temporaryName(path);
  std::unique_ptr<std::FILE, CloseFile> file(std::fopen(temporary.c_str(), "wb"));
  if (!file)
  {
    return unwritable(path, errno);
  }
  const bool written =
    std::fwrite(bytes, 1, size, file.get()) == size && std::fflush(file.get()) == 0;
  const int reason = errno;
  file.reset();
  if (!written || std::rename(temporary.c_str(), path.c_str()) != 0)
  {
    const int cause = written ? errno : reason;
    std::remove(temporary.c_str());
    return unwritable(path, cause);
  }
  return {};
}

Result<void> writeWholeFile(const std::string& path, const std::string& text)
{
  return writeWholeFile(path, text.data(), text.size());
}

Result<void> checkWritable(const std::string& path)
{
  if (std::filesystem::is_directory(path))
  {
    return unwritable(path, EISDIR);
  }
  const std::string temporary = temporaryName(path);
  const std::unique_ptr<std::FILE, CloseFile> file(std::fopen(temporary.c_str(), "wb"));
  if (!file)
  {
    return unwritable(path, errno);
  }
  std::remove(temporary.c_str());
  return {};
}

} // namespace pointfront
