#include "TextBytes.h"

#include "pointfront/Disk/SmallFile.h"

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string_view>

#include <unistd.h>
#include <zlib.h>

namespace pointfront
{
namespace
{
constexpr std::size_t beginningBytes = 1 << 18;
constexpr std::size_t blockBytes = 1 << 20;

enum class Coding
{
  Bytes,
  Utf16Little,
  Utf16Big
};

Coding codingOf(std::string_view text)
{
  constexpr std::size_t looked = 64;
  const auto byte = [&text](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  if (text.size() < 4)
  {
    return Coding::Bytes;
  }
  if (byte(0) == 0xff && byte(1) == 0xfe)
  {
    return Coding::Utf16Little;
  }
  if (byte(0) == 0xfe && byte(1) == 0xff)
  {
    return Coding::Utf16Big;
  }
  std::size_t zeros[2] = { 0, 0 };
  const std::size_t end = std::min(text.size(), looked) & ~std::size_t(1);
  for (std::size_t i = 0; i < end; ++i)
  {
    zeros[i % 2] += byte(i) == 0 ? 1 : 0;
  }
  // Numbers and Latin names: the upper byte of every unit is zero, the lower never.
  return zeros[1] == end / 2 && zeros[0] == 0 ? Coding::Utf16Little
    : zeros[0] == end / 2 && zeros[1] == 0    ? Coding::Utf16Big
                                              : Coding::Bytes;
}

void appendUtf8(std::uint32_t code, std::string& to)
{
  const auto put = [&to](std::uint32_t byte) { to += static_cast<char>(byte); };
  if (code < 0x80)
  {
    put(code);
  }
  else if (code < 0x800)
  {
    put(0xc0 | code >> 6);
    put(0x80 | (code & 0x3f));
  }
  else if (code < 0x10000)
  {
    put(0xe0 | code >> 12);
    put(0x80 | (code >> 6 & 0x3f));
    put(0x80 | (code & 0x3f));
  }
  else
  {
    put(0xf0 | code >> 18);
    put(0x80 | (code >> 12 & 0x3f));
    put(0x80 | (code >> 6 & 0x3f));
    put(0x80 | (code & 0x3f));
  }
}

/// UTF-16 from unit to unit; keeps the first half of a pair for the next piece.
class Utf16Decoder
{
public:
  explicit Utf16Decoder(Coding coding)
    : big_(coding == Coding::Utf16Big)
  {
  }
  void decode(std::string_view bytes, std::string& to)
  {
    constexpr std::uint32_t mark = 0xfeff;
    constexpr std::uint32_t wrong = '?';
    for (std::size_t i = 0; i + 1 < bytes.size(); i += 2)
    {
      const auto first = static_cast<unsigned char>(bytes[i]);
      const auto second = static_cast<unsigned char>(bytes[i + 1]);
      const std::uint32_t unit = big_ ? first << 8 | second : second << 8 | first;
      const bool low = (unit & 0xfc00) == 0xdc00;
      if (high_ != 0 && low)
      {
        appendUtf8(0x10000 + ((high_ & 0x3ff) << 10 | (unit & 0x3ff)), to);
        high_ = 0;
        continue;
      }
      if (high_ != 0 || low)
      {
        appendUtf8(wrong, to);
      }
      high_ = (unit & 0xfc00) == 0xd800 ? unit : 0;
      if (high_ == 0 && !low && unit != mark)
      {
        appendUtf8(unit, to);
      }
    }
  }

private:
  bool big_;
  std::uint32_t high_ = 0;
};

bool isGzip(const std::string& path)
{
  return beginningOf(path, 2) == "\x1f\x8b";
}

struct CloseGzip
{
  void operator()(gzFile file) const { ::gzclose(file); }
};
using GzipFile = std::unique_ptr<std::remove_pointer_t<gzFile>, CloseGzip>;

/// A file that has no name and is gone with its descriptor.
class NamelessFile
{
public:
  explicit NamelessFile(const std::string& folder)
  {
    std::error_code none;
    folder_ = folder.empty() ? std::filesystem::temp_directory_path(none).string() : folder;
    std::string name = folder_ + "/pointfront-text-XXXXXX";
    descriptor_ = ::mkstemp(name.data());
    reason_ = errno;
    if (descriptor_ >= 0)
    {
      ::unlink(name.c_str());
    }
  }
  ~NamelessFile()
  {
    if (descriptor_ >= 0)
    {
      ::close(descriptor_);
    }
  }
  NamelessFile(const NamelessFile&) = delete;
  NamelessFile& operator=(const NamelessFile&) = delete;

  bool append(std::string_view bytes)
  {
    while (descriptor_ >= 0 && !bytes.empty())
    {
      const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
      if (count <= 0)
      {
        reason_ = count < 0 ? errno : ENOSPC;
        return false;
      }
      bytes.remove_prefix(static_cast<std::size_t>(count));
    }
    return descriptor_ >= 0;
  }
  Error error(const std::string& path) const
  {
    return makeError(Error::Kind::Unwritable,
      path + ": cannot be unpacked into '" + folder_ + "' (" + std::strerror(reason_) +
        "); --temp chooses another folder");
  }
  /// The map outlives the descriptor.
  Result<MemoryMap> map() const
  {
    return MemoryMap::open("/proc/self/fd/" + std::to_string(descriptor_));
  }

private:
  std::string folder_;
  int descriptor_ = -1;
  int reason_ = 0;
};

Result<MemoryMap> unpacked(const std::string& path, const std::string& folder)
{
  const GzipFile packed(::gzopen(path.c_str(), "rb"));
  NamelessFile file(folder);
  std::string block(blockBytes, '\0');
  for (;;)
  {
    const int count =
      packed ? ::gzread(packed.get(), block.data(), static_cast<unsigned>(block.size())) : -1;
    int status = Z_OK;
    const char* const why = packed ? ::gzerror(packed.get(), &status) : "it cannot be opened";
    if (count < 0 || status == Z_BUF_ERROR)
    {
      return makeError(status == Z_BUF_ERROR ? Error::Kind::Truncated : Error::Kind::BadFormat,
        path + ": damaged gzip data: " + why);
    }
    if (count == 0)
    {
      return file.map();
    }
    if (!file.append({ block.data(), static_cast<std::size_t>(count) }))
    {
      return file.error(path);
    }
  }
}

Result<MemoryMap> transcoded(
  const MemoryMap& map, Coding coding, const std::string& path, const std::string& folder)
{
  const std::string_view text(reinterpret_cast<const char*>(map.data()), map.size());
  NamelessFile file(folder);
  Utf16Decoder decoder(coding);
  std::string block;
  for (std::size_t begin = 0; begin < text.size(); begin += blockBytes)
  {
    block.clear();
    decoder.decode(text.substr(begin, blockBytes), block);
    map.release(begin, std::min(blockBytes, text.size() - begin));
    if (!file.append(block))
    {
      return file.error(path);
    }
  }
  return file.map();
}

bool isUtf8(const std::string& text)
{
  std::size_t following = 0;
  for (const char c : text)
  {
    const auto byte = static_cast<unsigned char>(c);
    if (following > 0)
    {
      if ((byte & 0xc0) != 0x80)
      {
        return false;
      }
      --following;
      continue;
    }
    following = byte < 0x80 ? 0 : (byte & 0xe0) == 0xc0 ? 1 : (byte & 0xf0) == 0xe0 ? 2 : 3;
    if (byte >= 0xf8 || (byte & 0xc0) == 0x80)
    {
      return false;
    }
  }
  return following == 0;
}
} // namespace

Result<MemoryMap> mapText(const std::string& path, const std::string& temporaryFolder)
{
  Result<MemoryMap> map = isGzip(path) ? unpacked(path, temporaryFolder) : MemoryMap::open(path);
  if (!map)
  {
    return map;
  }
  const std::string_view text(reinterpret_cast<const char*>(map->data()), map->size());
  const Coding coding = codingOf(text);
  return coding == Coding::Bytes ? std::move(map) : transcoded(*map, coding, path, temporaryFolder);
}

std::string beginningOfText(const std::string& path)
{
  if (beginningOf(path, 1).empty())
  {
    return {}; // zlib would wait for the other end of a pipe
  }
  std::string text(beginningBytes, '\0');
  // Reads what is not packed as it is.
  const GzipFile file(::gzopen(path.c_str(), "rb"));
  const int count =
    file ? ::gzread(file.get(), text.data(), static_cast<unsigned>(text.size())) : 0;
  text.resize(static_cast<std::size_t>(std::max(count, 0)));
  const bool whole = text.size() < beginningBytes;
  if (const Coding coding = codingOf(text); coding != Coding::Bytes)
  {
    std::string decoded;
    Utf16Decoder(coding).decode(text, decoded);
    text = std::move(decoded);
  }
  const std::size_t lastLine = text.find_last_of("\n\r");
  return whole || lastLine == std::string::npos ? text : text.substr(0, lastLine + 1);
}

std::size_t markBytes(std::string_view text)
{
  return text.substr(0, 3) == "\xef\xbb\xbf" ? 3 : 0;
}

std::string toUtf8(const std::string& text)
{
  if (isUtf8(text))
  {
    return text;
  }
  std::string utf8;
  for (const char c : text)
  {
    appendUtf8(static_cast<unsigned char>(c), utf8);
  }
  return utf8;
}

} // namespace pointfront
