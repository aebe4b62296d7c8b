#include "pointfront/Table/RecordWriter.h"

#include "pointfront/Table/FieldRole.h"

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
  const FieldNames names(description.schema, fieldName);
  renamed_ = names.findings();
  RecordFile::Header header = describe(description.schema, names, encoder);
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
  std::vector<std::string> all = renamed_;
  const std::vector<std::string> rounded = file_ ? file_->findings() : std::vector<std::string>();
  all.insert(all.end(), rounded.begin(), rounded.end());
  return all;
}

} // namespace pointfront
