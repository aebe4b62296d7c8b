#include "pointfront/Disk/ByteSource.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Disk/InputFile.h"

#include <cstring>
#include <utility>

namespace pointfront
{

ByteSource::ByteSource(std::string path, std::uint64_t bytes)
  : path_(std::move(path))
  , bytes_(bytes)
{
}

Result<void> ByteSource::readUntil(
  const ReadStop& stop, const ByteRange* ranges, std::size_t count) const
{
  return stop ? makeError(Error::Kind::Cancelled, "nobody wants this part of '" + path_ + "' now")
              : read(ranges, count);
}

Result<void> ByteSource::readAt(std::uint64_t offset, std::byte* target, std::size_t size) const
{
  const ByteRange range{ offset, size, target };
  return read(&range, 1);
}

Result<RawBytes> ByteSource::readAt(std::uint64_t offset, std::size_t size) const
{
  RawBytes bytes(size);
  const Result<void> done = readAt(offset, bytes.data.get(), size);
  return done ? Result<RawBytes>(std::move(bytes)) : done.error();
}

Result<std::shared_ptr<const ByteSource>> openBytes(
  const std::string& path, const FirstBytes& first)
{
  const std::string scheme = schemeOf(path);
  if (scheme.empty())
  {
    Result<std::unique_ptr<const InputFile>> file = InputFile::open(path);
    if (!file)
    {
      return file.error();
    }
    return std::shared_ptr<const ByteSource>(std::move(*file));
  }
  const std::shared_ptr<const ByteOpener> opener = ByteOpeners::ofProcess().find(scheme);
  if (!opener)
  {
    return makeError(Error::Kind::Unsupported,
      "'" + scheme + "://...' is an address that this program does not open; " +
        ByteOpeners::ofProcess().schemesInWords());
  }
  return opener->open(path, first);
}

bool beginsWith(const std::string& path, const void* bytes, std::size_t size)
{
  const Result<std::shared_ptr<const ByteSource>> source = openBytes(path, { size, 0 });
  if (!source || (*source)->bytes() < size)
  {
    return false;
  }
  const Result<RawBytes> beginning = (*source)->readAt(0, size);
  return beginning && std::memcmp(beginning->data.get(), bytes, size) == 0;
}

} // namespace pointfront
