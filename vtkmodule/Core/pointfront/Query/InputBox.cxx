#include "pointfront/Query/InputBox.h"

#include "pointfront/Base/NumberText.h"

#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

namespace pointfront
{
namespace
{
std::string textOf(const Bounds& box)
{
  std::string text;
  for (const double value : { box.low.x, box.low.y, box.low.z, box.high.x, box.high.y, box.high.z })
  {
    text += (text.empty() ? "" : ",") + numberText(value, 10);
  }
  return text;
}

/// Leaves of an array what is kept, in its order.
void compact(std::byte* values, std::size_t bytes, const std::vector<std::uint8_t>& keep)
{
  std::byte* to = values;
  for (std::size_t i = 0; i < keep.size(); ++i)
  {
    if (keep[i] != 0)
    {
      std::memmove(to, values + i * bytes, bytes);
      to += bytes;
    }
  }
}
} // namespace

/// A source whose points outside of the box are left out.
class InputBox::CutSource final : public PointSource
{
public:
  CutSource(const Bounds& box, std::unique_ptr<PointSource> source,
    std::shared_ptr<OutsideOfChunks> outside)
    : box_(box)
    , source_(std::move(source))
    , outside_(std::move(outside))
    , description_(source_->description())
  {
    Bounds& declared = description_.declaredBounds;
    if (!declared.empty())
    {
      declared.low = glm::max(declared.low, box.low);
      declared.high = glm::min(declared.high, box.high);
      declared = declared.empty() ? Bounds() : declared;
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
    Result<void> done = source_->read(chunk, batch);
    return done ? cutBatch(chunk, batch) : done;
  }
  Result<void> readSteps(std::uint64_t chunk, PointBatch& batch) const override
  {
    Result<void> done = source_->readSteps(chunk, batch);
    return done ? cutBatch(chunk, batch) : done;
  }

private:
  /// The place of a point, whichever of the two ways it was read by.
  glm::dvec3 placeOf(const PointBatch& batch, std::size_t point) const
  {
    if (!batch.steps.empty())
    {
      return description_.grid->toWorld(GridPosition(batch.steps[point]));
    }
    const glm::dvec3& read = batch.positions[point];
    if (!description_.grid)
    {
      return read;
    }
    const QuantisationGrid& grid = *description_.grid;
    constexpr double mostSteps = 9e15; // doubles hold them all; not NaN, either
    const bool onGrid =
      glm::all(glm::lessThan(glm::abs((read - grid.offset) / grid.scale), glm::dvec3(mostSteps)));
    return onGrid ? grid.toWorld(grid.toGrid(read)) : read;
  }
  Result<void> cutBatch(std::uint64_t chunk, PointBatch& batch) const
  {
    const std::size_t points = batch.size();
    std::vector<std::uint8_t> keep(points);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < points; ++i)
    {
      keep[i] = box_.contains(placeOf(batch, i)) ? 1 : 0;
      kept += keep[i];
    }
    (*outside_)[static_cast<std::size_t>(chunk)] = points - kept;
    if (kept == points)
    {
      return {};
    }
    if (!batch.steps.empty())
    {
      compact(reinterpret_cast<std::byte*>(batch.steps.data()), sizeof(glm::ivec3), keep);
      batch.steps.resize(kept);
    }
    else
    {
      compact(reinterpret_cast<std::byte*>(batch.positions.data()), sizeof(glm::dvec3), keep);
      batch.positions.resize(kept);
    }
    for (std::size_t c = 0; c < description_.schema.size(); ++c)
    {
      const std::size_t bytes = description_.schema[c].bytes();
      compact(batch.columns[c].data(), bytes, keep);
      batch.columns[c].resize(kept * bytes);
    }
    return {};
  }

  Bounds box_;
  std::unique_ptr<PointSource> source_;
  std::shared_ptr<OutsideOfChunks> outside_;
  SourceDescription description_;
};

Result<std::shared_ptr<InputBox>> InputBox::make(const Bounds& box)
{
  if (box.empty()) // also where an end is NaN
  {
    return makeError(Error::Kind::BadArgument,
      textOf(box) + " is not a box: it begins with its lower corner, and every end is a number");
  }
  return std::shared_ptr<InputBox>(new InputBox(box));
}

std::unique_ptr<PointSource> InputBox::cut(std::unique_ptr<PointSource> source)
{
  const auto outside =
    std::make_shared<OutsideOfChunks>(static_cast<std::size_t>(source->chunkCount()));
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    inputs_.add(source->description().declaredBounds);
    outside_.push_back(outside);
  }
  return std::make_unique<CutSource>(box_, std::move(source), outside);
}

void InputBox::leaveOut(const Bounds& input)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  inputs_.add(input);
}

Result<void> InputBox::keepInside(std::vector<std::unique_ptr<PointSource>>& sources) const
{
  const bool any = std::any_of(sources.begin(), sources.end(),
    [](const auto& source) { return source->description().pointCount > 0; });
  if (!any)
  {
    return nothingInside();
  }
  sources.erase(std::remove_if(sources.begin(), sources.end(),
                  [](const auto& source) { return source->description().pointCount == 0; }),
    sources.end());
  return {};
}

Error InputBox::nothingInside() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  std::string what = "no point of the inputs lies in the box " + textOf(box_);
  if (!inputs_.empty())
  {
    what += "; the inputs lie in " + textOf(inputs_) + ", in their own coordinates";
  }
  return makeError(Error::Kind::BadArgument, what);
}

std::uint64_t InputBox::pointsOutside() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  std::uint64_t sum = 0;
  for (const auto& chunks : outside_)
  {
    for (const std::atomic<std::uint64_t>& chunk : *chunks)
    {
      sum += chunk;
    }
  }
  return sum;
}

} // namespace pointfront
