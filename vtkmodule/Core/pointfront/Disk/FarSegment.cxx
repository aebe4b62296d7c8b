#include "pointfront/Disk/FarSegment.h"

#include "pointfront/Codec/Checksum.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <ctime>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>
#include <vector>

namespace pointfront
{
namespace
{
constexpr std::array<char, 8> magic{ 'P', 'F', 'C', 'A', 'C', 'H', 'E', '1' };
constexpr std::size_t headerBytes = 4096;
constexpr std::size_t mostLabel = headerBytes - 16;
constexpr std::time_t touchedFor = 60; ///< seconds; a use within them need not be noted again

struct Record
{
  std::uint32_t checksum = 0;
  std::uint32_t size = 0; ///< 0: the block is not there
};
constexpr std::size_t dataAt = headerBytes + FarSegment::blocks * sizeof(Record);

class OpenFile
{
public:
  OpenFile(const std::string& path, int flags)
    : file_(::open(path.c_str(), flags | O_CLOEXEC | O_NOFOLLOW, 0600))
  {
  }
  ~OpenFile()
  {
    if (file_ >= 0)
    {
      ::close(file_);
    }
  }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  bool sound() const { return file_ >= 0; }
  int number() const { return file_; }
  bool read(std::size_t at, void* target, std::size_t size) const
  {
    auto* to = static_cast<char*>(target);
    while (size > 0)
    {
      const ::ssize_t got = ::pread(file_, to, size, static_cast<::off_t>(at));
      if (got <= 0)
      {
        return false;
      }
      to += got;
      at += static_cast<std::size_t>(got);
      size -= static_cast<std::size_t>(got);
    }
    return true;
  }
  bool write(std::size_t at, const void* data, std::size_t size) const
  {
    const auto* from = static_cast<const char*>(data);
    while (size > 0)
    {
      const ::ssize_t put = ::pwrite(file_, from, size, static_cast<::off_t>(at));
      if (put <= 0)
      {
        return false;
      }
      from += put;
      at += static_cast<std::size_t>(put);
      size -= static_cast<std::size_t>(put);
    }
    return true;
  }

private:
  int file_;
};

/// How long ago it was used decides which segment goes first.
void noteUse(const OpenFile& file)
{
  struct stat state
  {
  };
  if (::fstat(file.number(), &state) == 0 && std::time(nullptr) - state.st_mtime > touchedFor)
  {
    ::futimens(file.number(), nullptr);
  }
}

bool isWhole(const std::byte* data, const Record& record)
{
  return record.size > 0 && record.size <= FarSegment::blockBytes &&
    matchesChecksum(data, record.size, record.checksum);
}

bool hasHeader(const OpenFile& file, const std::string& header)
{
  std::string found(headerBytes, '\0');
  return file.read(0, found.data(), found.size()) && found == header;
}

/// Makes it a segment with this header, without blocks unless it was one.
bool beginSegment(const OpenFile& file, const std::string& header)
{
  // Who begins it beside another writer would take out that one's blocks. Where a disk has no locks
  // they may be lost; none is wrong.
  ::flock(file.number(), LOCK_EX);
  const std::vector<Record> none(FarSegment::blocks);
  return hasHeader(file, header) ||
    (::ftruncate(file.number(), 0) == 0 &&
      file.write(headerBytes, none.data(), none.size() * sizeof(Record)) &&
      file.write(0, header.data(), header.size()));
}
} // namespace

FarSegment::FarSegment(std::string path, std::string label)
  : path_(std::move(path))
  , label_(std::move(label))
{
}

std::string FarSegment::header() const
{
  std::string text(headerBytes, '\0');
  const auto size = static_cast<std::uint32_t>(label_.size());
  const std::uint32_t checksum =
    checksumOf(reinterpret_cast<const std::byte*>(label_.data()), label_.size());
  std::memcpy(text.data(), magic.data(), magic.size());
  std::memcpy(text.data() + 8, &size, 4);
  std::memcpy(text.data() + 12, &checksum, 4);
  std::memcpy(text.data() + 16, label_.data(), label_.size());
  return text;
}

bool FarSegment::read(std::uint64_t offset, std::size_t size, std::byte* target) const
{
  if (size == 0 || offset + size > bytes || label_.size() > mostLabel)
  {
    return false;
  }
  const OpenFile file(path_, O_RDONLY);
  if (!file.sound() || !hasHeader(file, header()))
  {
    return false;
  }
  const auto first = static_cast<std::size_t>(offset / blockBytes);
  const auto last = static_cast<std::size_t>((offset + size - 1) / blockBytes);
  std::vector<Record> records(last - first + 1);
  if (!file.read(
        headerBytes + first * sizeof(Record), records.data(), records.size() * sizeof(Record)))
  {
    return false;
  }
  std::vector<std::byte> data(records.size() * blockBytes);
  const std::size_t held = (records.size() - 1) * blockBytes + records.back().size;
  if (held > data.size() || !file.read(dataAt + first * blockBytes, data.data(), held))
  {
    return false;
  }
  for (std::size_t i = 0; i < records.size(); ++i)
  {
    const bool full = i + 1 == records.size() || records[i].size == blockBytes;
    if (!full || !isWhole(data.data() + i * blockBytes, records[i]))
    {
      return false;
    }
  }
  const auto begin = static_cast<std::size_t>(offset - first * blockBytes);
  if (begin + size > held)
  {
    return false;
  }
  std::memcpy(target, data.data() + begin, size);
  noteUse(file);
  return true;
}

bool FarSegment::write(std::uint64_t offset, const std::byte* data, std::size_t size) const
{
  if (size == 0 || offset % blockBytes != 0 || offset + size > bytes || label_.size() > mostLabel)
  {
    return true;
  }
  const OpenFile file(path_, O_RDWR | O_CREAT);
  if (!file.sound())
  {
    return false;
  }
  const std::string wanted = header();
  if (!hasHeader(file, wanted) && !beginSegment(file, wanted))
  {
    return false;
  }
  std::vector<Record> records;
  for (std::size_t at = 0; at < size; at += blockBytes)
  {
    const std::size_t held = std::min(blockBytes, size - at);
    records.push_back({ checksumOf(data + at, held), static_cast<std::uint32_t>(held) });
  }
  // The records last: a block without one is not there.
  const auto first = static_cast<std::size_t>(offset / blockBytes);
  return file.write(dataAt + first * blockBytes, data, size) &&
    file.write(
      headerBytes + first * sizeof(Record), records.data(), records.size() * sizeof(Record));
}

FarSegment::Check FarSegment::check(const std::string& path)
{
  Check report;
  const OpenFile file(path, O_RDONLY);
  std::string header(headerBytes, '\0');
  std::vector<Record> records(blocks);
  std::uint32_t size = 0;
  std::uint32_t checksum = 0;
  report.sound = file.sound() && file.read(0, header.data(), header.size()) &&
    file.read(headerBytes, records.data(), records.size() * sizeof(Record)) &&
    std::memcmp(header.data(), magic.data(), magic.size()) == 0;
  std::memcpy(&size, header.data() + 8, 4);
  std::memcpy(&checksum, header.data() + 12, 4);
  report.sound = report.sound && size <= mostLabel &&
    matchesChecksum(reinterpret_cast<const std::byte*>(header.data() + 16), size, checksum);
  std::vector<std::byte> data(blockBytes);
  for (std::size_t i = 0; report.sound && i < records.size(); ++i)
  {
    if (records[i].size == 0)
    {
      continue;
    }
    ++report.blocks;
    report.sound = records[i].size <= blockBytes &&
      file.read(dataAt + i * blockBytes, data.data(), records[i].size) &&
      isWhole(data.data(), records[i]);
  }
  return report;
}

} // namespace pointfront
