#include "pointfront/Disk/SmallFile.h"

#include "pointfront/Disk/InputFile.h"

#include <algorithm>

namespace pointfront
{

Result<RawBytes> readSmallFile(const std::string& path, std::uint64_t most)
{
  const Result<std::unique_ptr<const InputFile>> file = InputFile::open(path);
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
  const Result<std::unique_ptr<const InputFile>> file = InputFile::open(path);
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
