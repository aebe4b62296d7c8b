#pragma once

#include "pointfront/Ingest/RecordColumns.h"
#include "pointfront/Points/PointSource.h"

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <optional>
#include <utility>

namespace pointfront
{

/// A source that notes the largest value of its 16-bit colours ("rgb") while it is read, or says
/// what was noted before.
/// Threads  those of PointSource.
class KnownColours final : public PointSource
{
public:
  using Largest = std::shared_ptr<std::atomic<std::uint16_t>>;

  KnownColours(std::unique_ptr<PointSource> source, Largest noted)
    : source_(std::move(source))
    , description_(source_->description())
    , column_(wideColourColumn(description_.schema))
    , noted_(std::move(noted))
  {
  }
  KnownColours(std::unique_ptr<PointSource> source, std::uint16_t known)
    : KnownColours(std::move(source), nullptr)
  {
    description_.largestColour = known;
  }

  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return source_->chunkCount(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override
  {
    return source_->chunkPoints(chunk);
  }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    Result<void> done = source_->read(chunk, batch);
    if (done && noted_ && column_)
    {
      note(batch.columns[*column_]);
    }
    return done;
  }
  Result<void> readSteps(std::uint64_t chunk, PointBatch& batch) const override
  {
    return noted_ ? PointSource::readSteps(chunk, batch) : source_->readSteps(chunk, batch);
  }

private:
  void note(const std::vector<std::byte>& values) const
  {
    std::uint16_t largest = 0;
    for (std::size_t at = 0; at + 2 <= values.size(); at += 2)
    {
      std::uint16_t value = 0;
      std::memcpy(&value, values.data() + at, sizeof value);
      largest = std::max(largest, value);
    }
    std::uint16_t before = *noted_;
    while (before < largest && !noted_->compare_exchange_weak(before, largest))
    {
    }
  }

  std::unique_ptr<PointSource> source_;
  SourceDescription description_;
  std::optional<std::size_t> column_;
  Largest noted_; ///< null: nothing is noted
};

} // namespace pointfront
