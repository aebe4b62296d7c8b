#include "pointfront/Disk/SmallFile.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Threads/WorkerThread.h"

#include <algorithm>
#include <atomic>
#include <list>
#include <new>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::uint64_t atOnceBytes = std::uint64_t(1) << 20;
/// Far files that are read beside each other.
constexpr std::size_t filesAtOnce = 16;
} // namespace

Result<RawBytes> readSmallFile(const std::string& path, std::uint64_t most)
{
  // A far file of this size comes with its first answer.
  const Result<std::shared_ptr<const ByteSource>> file =
    openBytes(path, { static_cast<std::size_t>(std::min(most, atOnceBytes)), 0 });
  if (!file)
  {
    return file.error();
  }
  if ((*file)->bytes() > most)
  {
    return makeError(Error::Kind::BadFormat,
      "'" + path + "' has " + std::to_string((*file)->bytes()) +
        " bytes; a file of its kind has at most " + std::to_string(most));
  }
  return (*file)->readAt(0, static_cast<std::size_t>((*file)->bytes()));
}

std::vector<Result<RawBytes>> readSmallFiles(
  const std::vector<SmallFile>& files, const ReadStop& stop)
{
  std::vector<Result<RawBytes>> read;
  read.reserve(files.size());
  for (const SmallFile& file : files)
  {
    read.emplace_back(makeError(Error::Kind::Cancelled, "'" + file.path + "' is not wanted now"));
  }
  std::atomic<std::size_t> next{ 0 };
  const auto work = [&]
  {
    for (std::size_t i = next++; i < files.size() && !stop; i = next++)
    {
      try
      {
        read[i] = readSmallFile(files[i].path, files[i].most);
      }
      catch (const std::bad_alloc&)
      {
        read[i] = makeError(Error::Kind::NoMemory, "no memory for a file's content");
      }
    }
  };
  const auto far = static_cast<std::size_t>(std::count_if(
    files.begin(), files.end(), [](const SmallFile& file) { return isAddress(file.path); }));
  std::list<WorkerThread> threads;
  while (threads.size() + 1 < std::min(far, filesAtOnce))
  {
    if (!threads.emplace_back().start(work))
    {
      threads.pop_back();
      break; // the others, or this one alone, do it
    }
  }
  work();
  threads.clear(); // waits for them
  return read;
}

Result<std::string> readSmallText(const std::string& path, std::uint64_t most)
{
  const Result<RawBytes> bytes = readSmallFile(path, most);
  return bytes ? Result<std::string>(
                   std::string(reinterpret_cast<const char*>(bytes->data.get()), bytes->size))
               : bytes.error();
}

std::string beginningOf(const std::string& path, std::size_t bytes)
{
  const Result<std::shared_ptr<const ByteSource>> file = openBytes(path, { bytes, 0 });
  if (!file)
  {
    return {};
  }
  std::string text(std::min<std::size_t>(bytes, static_cast<std::size_t>((*file)->bytes())), '\0');
  const Result<void> done =
    (*file)->readAt(0, reinterpret_cast<std::byte*>(text.data()), text.size());
  return done ? text : std::string();
}

} // namespace pointfront
