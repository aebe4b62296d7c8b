#include "pointfront/Neighbourhood/PointColumn.h"

#include <cstring>
#include <filesystem>

namespace pointfront
{
namespace
{
/// One source with new attributes. Threads: as PointSource.
class AttributedSource final : public PointSource
{
public:
  AttributedSource(std::unique_ptr<PointSource> source, std::size_t number,
    const std::vector<Attribute>& attributes, ValueSource values,
    const std::function<void(SourceDescription&)>& describe)
    : source_(std::move(source))
    , number_(number)
    , values_(std::move(values))
    , description_(source_->description())
  {
    AttributeSchema schema;
    for (const Attribute& own : description_.schema)
    {
      Attribute kept = own;
      for (const Attribute& added : attributes)
      {
        kept = added.name == own.name ? added : kept;
      }
      schema.add(kept);
    }
    for (const Attribute& added : attributes)
    {
      schema.add(added); // nothing happens where it has replaced one
      columns_.push_back(*schema.find(added.name));
      bytes_.push_back(added.bytes());
      valueBytes_ += added.bytes();
    }
    description_.schema = std::move(schema);
    if (describe)
    {
      describe(description_);
    }
  }

  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return source_->chunkCount(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override
  {
    return source_->chunkPoints(chunk);
  }

  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    if (Result<void> done = source_->read(chunk, batch); !done)
    {
      return done;
    }
    std::vector<std::byte> values(batch.size() * valueBytes_);
    if (Result<void> done = values_({ number_, chunk }, batch, values.data()); !done)
    {
      return done;
    }
    batch.resize(batch.size(), description_.schema);
    std::size_t at = 0;
    for (std::size_t c = 0; c < columns_.size(); ++c)
    {
      for (std::size_t i = 0; i < batch.size(); ++i)
      {
        std::memcpy(batch.columns[columns_[c]].data() + i * bytes_[c],
          values.data() + i * valueBytes_ + at, bytes_[c]);
      }
      at += bytes_[c];
    }
    return {};
  }

private:
  std::unique_ptr<PointSource> source_;
  std::size_t number_;
  ValueSource values_;
  SourceDescription description_;
  std::vector<std::size_t> columns_; // columns of the new attributes
  std::vector<std::size_t> bytes_;
  std::size_t valueBytes_ = 0;
};
} // namespace

Result<std::unique_ptr<PointColumn>> PointColumn::create(
  const PassResources& resources, std::uint64_t points, std::size_t valueBytes)
{
  const std::string folder = resources.temporaryFolder.empty()
    ? std::filesystem::temp_directory_path().string()
    : resources.temporaryFolder;
  Result<std::unique_ptr<SpillFile>> file = SpillFile::create(folder, points * valueBytes);
  if (!file)
  {
    return file.error();
  }
  // The last byte makes the file as long as it will be: what is not written reads as zeros.
  const std::byte zero{};
  if (points > 0)
  {
    if (Result<void> done = (*file)->write(points * valueBytes - 1, &zero, 1); !done)
    {
      return done.error();
    }
  }
  return std::unique_ptr<PointColumn>(new PointColumn(std::move(*file), valueBytes));
}

Result<void> PointColumn::write(
  const std::vector<std::uint64_t>& numbers, const std::vector<std::byte>& values)
{
  for (std::size_t i = 0; i < numbers.size();)
  {
    std::size_t end = i + 1;
    while (end < numbers.size() && numbers[end] == numbers[end - 1] + 1)
    {
      ++end;
    }
    if (Result<void> done = file_->write(
          numbers[i] * valueBytes_, values.data() + i * valueBytes_, (end - i) * valueBytes_);
        !done)
    {
      return done;
    }
    i = end;
  }
  return {};
}

Result<void> PointColumn::read(std::uint64_t first, std::uint64_t count, std::byte* values) const
{
  return file_->read(first * valueBytes_, values, count * valueBytes_);
}

PointSources withAttributes(PointSources sources, const std::vector<Attribute>& attributes,
  const ValueSource& values, const std::function<void(SourceDescription&)>& describe)
{
  PointSources result;
  for (std::size_t s = 0; s < sources.size(); ++s)
  {
    result.push_back(
      std::make_unique<AttributedSource>(std::move(sources[s]), s, attributes, values, describe));
  }
  return result;
}

ValueSource valuesOf(std::shared_ptr<const PointColumn> column, InputOrder order)
{
  const auto shared = std::make_shared<const InputOrder>(std::move(order));
  return [column = std::move(column), shared](const SourceChunk& chunk, const PointBatch& batch,
           std::byte* values) { return column->read(shared->first(chunk), batch.size(), values); };
}

} // namespace pointfront
