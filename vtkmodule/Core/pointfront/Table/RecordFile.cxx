#include "pointfront/Table/RecordFile.h"

#include "pointfront/Base/LetterCase.h"

#include <cassert>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::size_t countLength = 20; // digits of 2^64

const std::byte* bytesOf(const std::string& text)
{
  return reinterpret_cast<const std::byte*>(text.data());
}
} // namespace

Result<std::unique_ptr<RecordFile>> RecordFile::create(
  const std::string& path, RecordEncoder encoder, Header header)
{
  Result<std::unique_ptr<OutputFile>> file = OutputFile::create(path);
  if (!file)
  {
    return file.error();
  }
  const std::string text = header(0);
  if (Result<void> done = (*file)->append(bytesOf(text), text.size()); !done)
  {
    return done.error();
  }
  return std::unique_ptr<RecordFile>(
    new RecordFile(std::move(encoder), std::move(header), std::move(*file)));
}

Result<void> RecordFile::append(const PointBatch& batch)
{
  records_.clear();
  encoder_.encode(batch, records_);
  points_ += batch.size();
  return file_->append(records_.data(), records_.size());
}

Result<void> RecordFile::finish()
{
  const std::string text = header_(points_);
  assert(text.size() == header_(0).size());
  if (Result<void> done = file_->overwrite(0, bytesOf(text), text.size()); !done)
  {
    return done;
  }
  return file_->publish();
}

std::string paddedCount(std::uint64_t count)
{
  std::string text = std::to_string(count);
  text.resize(countLength, ' ');
  return text;
}

std::string fieldName(const std::string& attribute)
{
  std::string name = attribute;
  for (char& c : name)
  {
    const bool kept = isAsciiLetterOrDigit(c) || c == '[' || c == ']';
    c = kept ? c : '_';
  }
  return name.empty() ? "_" : name;
}

} // namespace pointfront
