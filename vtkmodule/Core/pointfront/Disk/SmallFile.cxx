#include "pointfront/Disk/SmallFile.h"

#include "pointfront/Disk/ByteSource.h"

#include <algorithm>

namespace pointfront
{
namespace
{
constexpr std::uint64_t atOnceBytes = std::uint64_t(1) << 20;
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
