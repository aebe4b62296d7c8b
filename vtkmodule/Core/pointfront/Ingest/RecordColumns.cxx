#include "pointfront/Ingest/RecordColumns.h"

#include <algorithm>
#include <cstring>

namespace pointfront
{
namespace
{
using Sources = std::vector<std::unique_ptr<PointSource>>;

/// Decoded twice: a fraction of a percent of the clouds for which it matters.
constexpr std::uint64_t guessedChunks = 6;

/// The columns that all chunks seen so far have in common.
class Candidates
{
public:
  Candidates(const CommonSchema& common, const ColumnGuess& guess)
    : common_(common)
    , may_(guess.mayBeConstant)
    , values_(common.schema.size())
  {
    if (guess.mayBeNarrow)
    {
      narrow_ = wideColourColumn(common.schema);
    }
  }

  void see(const AttributeSchema& own, std::size_t source, const PointBatch& batch)
  {
    if (batch.size() == 0)
    {
      return;
    }
    seen_ = true;
    for (std::size_t c = 0; c < values_.size(); ++c)
    {
      if (may_[c] || narrow_ == c)
      {
        seeColumn(c, own, common_.mappings[source][c], batch);
      }
    }
  }

  RecordColumns columns()
  {
    for (std::size_t c = 0; c < values_.size(); ++c)
    {
      if (!may_[c] || !seen_)
      {
        values_[c].reset();
      }
    }
    return { common_.schema, std::move(values_), seen_ ? narrow_ : std::nullopt };
  }

private:
  void seeColumn(std::size_t c, const AttributeSchema& own, const ColumnMapping& mapping,
    const PointBatch& batch)
  {
    const std::size_t bytes = common_.schema[c].bytes();
    converted_.assign(bytes * (mapping.column ? 0 : 1), std::byte(0));
    const std::byte* values = converted_.data();
    std::size_t count = 1;
    if (mapping.column)
    {
      values = batch.columns[*mapping.column].data();
      count = batch.size();
      if (mapping.converted)
      {
        converted_.resize(count * bytes);
        convertColumn(own[*mapping.column], values, common_.schema[c], converted_.data(), count);
        values = converted_.data();
      }
    }
    if (may_[c])
    {
      if (!values_[c])
      {
        values_[c] = ConstantValue(values, values + bytes);
      }
      may_[c] = allAre(values, bytes, count, values_[c]->data());
    }
    if (narrow_ == c)
    {
      for (std::size_t i = 1; i < count * bytes; i += 2)
      {
        if (values[i] != std::byte(0)) // the upper byte: records are of this machine, little-endian
        {
          narrow_.reset();
          break;
        }
      }
    }
  }

  const CommonSchema& common_;
  std::vector<bool> may_;
  std::vector<std::optional<ConstantValue>> values_;
  std::optional<std::size_t> narrow_;
  std::vector<std::byte> converted_;
  bool seen_ = false;
};
} // namespace

RecordColumns::RecordColumns(const AttributeSchema& common,
  std::vector<std::optional<ConstantValue>> constants, std::optional<std::size_t> narrow)
  : constants_(std::move(constants))
  , narrowed_(narrow)
{
  constants_.resize(common.size());
  if (narrowed_ && constants_[*narrowed_])
  {
    narrowed_.reset();
  }
  for (std::size_t c = 0; c < common.size(); ++c)
  {
    places_.emplace_back();
    if (!constants_[c])
    {
      places_.back() = schema_.size();
      Attribute attribute = common[c];
      attribute.type = narrowed_ == c ? ScalarType::UInt8 : attribute.type;
      schema_.add(std::move(attribute));
    }
  }
}

RecordColumns RecordColumns::carrying(
  const AttributeSchema& common, const std::vector<bool>& columns) const
{
  auto constants = constants_;
  auto narrow = narrowed_;
  for (std::size_t c = 0; c < columns.size(); ++c)
  {
    if (columns[c])
    {
      constants[c].reset();
      narrow = narrow == c ? std::nullopt : narrow;
    }
  }
  return { common, std::move(constants), narrow };
}

RecordColumns guessColumns(
  const Sources& sources, const CommonSchema& common, const ColumnGuess& guess)
{
  Candidates candidates(common, guess);
  std::uint64_t chunks = 0;
  for (const auto& source : sources)
  {
    chunks += source->chunkCount();
  }
  const std::uint64_t looks = std::min(chunks, guessedChunks);
  std::uint64_t before = 0;
  std::size_t source = 0;
  PointBatch batch;
  for (std::uint64_t i = 0; i < looks; ++i)
  {
    const std::uint64_t chunk = looks == 1 ? 0 : i * (chunks - 1) / (looks - 1);
    while (chunk >= before + sources[source]->chunkCount())
    {
      before += sources[source++]->chunkCount();
    }
    if (sources[source]->read(chunk - before, batch))
    {
      candidates.see(sources[source]->description().schema, source, batch);
    }
  }
  return candidates.columns();
}

std::optional<std::size_t> wideColourColumn(const AttributeSchema& schema)
{
  for (std::size_t c = 0; c < schema.size(); ++c)
  {
    if (schema[c].name == "rgb" && schema[c].type == ScalarType::UInt16)
    {
      return c;
    }
  }
  return std::nullopt;
}

bool allAre(const std::byte* values, std::size_t bytes, std::size_t count, const std::byte* value)
{
  return count == 0 ||
    (std::memcmp(values, value, bytes) == 0 &&
      std::memcmp(values, values + bytes, (count - 1) * bytes) == 0);
}

} // namespace pointfront
