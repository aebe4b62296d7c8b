#include "pointfront/Table/RecordWriter.h"

#include <cassert>
#include <utility>

namespace pointfront
{

RecordWriter::RecordWriter(std::string path)
  : path_(std::move(path))
{
}

Result<void> RecordWriter::begin(const SinkDescription& description)
{
  assert(!file_);
  RecordEncoder encoder(description.schema, coordinates(description));
  RecordFile::Header header = describe(description.schema, encoder);
  Result<std::unique_ptr<RecordFile>> file =
    RecordFile::create(path_, std::move(encoder), std::move(header));
  if (!file)
  {
    return file.error();
  }
  file_ = std::move(*file);
  return {};
}

Result<void> RecordWriter::append(const PointBatch& batch)
{
  assert(file_);
  return file_->append(batch);
}

Result<void> RecordWriter::finish()
{
  assert(file_);
  return file_->finish();
}

std::vector<std::string> RecordWriter::findings() const
{
  return file_ ? file_->findings() : std::vector<std::string>();
}

} // namespace pointfront
