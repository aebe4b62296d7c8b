#include "RasterSource.h"

#include "SortedRasterValues.h"

#include <cstring>
#include <utility>

namespace pointfront
{

RasterSource::RasterSource(std::unique_ptr<PointSource> original,
  std::shared_ptr<ImageValuesPass::Images> images, std::vector<Input> inputs,
  AttributeSchema schema)
  : original_(std::move(original))
  , images_(std::move(images))
  , inputs_(std::move(inputs))
  , description_(original_->description())
  , counted_(original_->chunkCount())
{
  description_.schema = std::move(schema);
  description_.largestColour.reset(); // images may have larger ones
  for (const Input& input : inputs_)
  {
    if (!input.column.wideImage().empty())
    {
      description_.colourImage = input.column.wideImage();
    }
  }
}

void RasterSource::use(std::shared_ptr<const SortedRasterValues> sorted, std::size_t number)
{
  sorted_ = std::move(sorted);
  number_ = number;
}

Result<void> RasterSource::read(std::uint64_t chunk, PointBatch& batch) const
{
  if (Result<void> done = original_->read(chunk, batch); !done)
  {
    return done;
  }
  const std::size_t own = batch.columns.size();
  batch.columns.resize(description_.schema.size());
  for (std::size_t c = own; c < batch.columns.size(); ++c)
  {
    batch.columns[c].assign(batch.size() * description_.schema[c].bytes(), std::byte(0));
  }
  for (const Input& input : inputs_)
  {
    input.column.widen(batch.columns[input.target]);
  }
  const bool count = !counted_[chunk].exchange(true);
  if (sorted_)
  {
    const Result<std::vector<std::byte>> values = sorted_->read({ number_, chunk }, batch.size());
    if (!values)
    {
      return values.error();
    }
    for (std::size_t input = 0; input < inputs_.size(); ++input)
    {
      fill(input, count, *values, batch);
    }
    return {};
  }
  for (std::size_t input = 0; input < inputs_.size(); ++input)
  {
    if (Result<void> done = fill(input, count, batch); !done)
    {
      return makeError(done.error().kind,
        done.error().what + " (while points of '" + description_.path + "' were read)");
    }
  }
  return {};
}

Result<void> RasterSource::fill(std::size_t input, bool count, PointBatch& batch) const
{
  const RasterColumn& column = inputs_[input].column;
  std::vector<std::byte>& bytes = batch.columns[inputs_[input].target];
  const std::size_t step = column.attribute().bytes();
  std::uint64_t notHeld = 0;
  const Result<std::uint64_t> without =
    images_->mosaics[input].sample(batch.positions, inputs_[input].ways,
      [&](std::size_t point, const RasterFile& file, const std::byte* pixel)
      {
        const auto outcome = column.store(file, pixel, bytes.data() + point * step);
        notHeld += outcome == RasterColumn::Outcome::NotHeld ? 1 : 0;
        return outcome != RasterColumn::Outcome::NoData;
      });
  if (!without)
  {
    return without.error();
  }
  if (count)
  {
    RasterTally& tally = *images_->tallies[input];
    tally.seen += batch.size();
    tally.without += *without;
    tally.notHeld += notHeld;
  }
  return {};
}

void RasterSource::fill(
  std::size_t input, bool count, const std::vector<std::byte>& values, PointBatch& batch) const
{
  using Outcome = SortedRasterValues::Outcome;
  std::byte* const column = batch.columns[inputs_[input].target].data();
  const std::size_t step = inputs_[input].column.attribute().bytes();
  std::uint64_t without = 0;
  std::uint64_t notHeld = 0;
  for (std::size_t i = 0; i < batch.size(); ++i)
  {
    const std::byte* const value =
      values.data() + i * sorted_->valueBytes() + sorted_->place(input);
    const auto outcome = static_cast<Outcome>(*value);
    without += outcome == Outcome::Without ? 1 : 0;
    notHeld += outcome == Outcome::NotHeld ? 1 : 0;
    if (outcome == Outcome::Taken)
    {
      std::memcpy(column + i * step, value + 1, step);
    }
  }
  if (count)
  {
    RasterTally& tally = *images_->tallies[input];
    tally.seen += batch.size();
    tally.without += without;
    tally.notHeld += notHeld;
  }
}

} // namespace pointfront
