#include "WholeFile.h"

#include "pointfront/Disk/OutputFile.h"

namespace pointfront
{

Result<void> writeWholeFile(const std::string& path, const void* bytes, std::size_t size)
{
  Result<std::unique_ptr<OutputFile>> file = OutputFile::create(path, OutputFile::Durability::None);
  if (!file)
  {
    return file.error();
  }
  Result<void> done = (*file)->append(static_cast<const std::byte*>(bytes), size);
  return done ? (*file)->publish() : done;
}

Result<void> writeWholeFile(const std::string& path, const std::string& text)
{
  return writeWholeFile(path, text.data(), text.size());
}

Result<void> checkWritable(const std::string& path)
{
  const Result<std::unique_ptr<OutputFile>> file =
    OutputFile::create(path, OutputFile::Durability::None);
  return file ? Result<void>() : Result<void>(file.error());
}

} // namespace pointfront
