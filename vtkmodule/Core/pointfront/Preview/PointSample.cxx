#include "pointfront/Preview/PointSample.h"

#include <cstring>

namespace pointfront
{
namespace
{
/// SplitMix64.
class StepRandom
{
public:
  explicit StepRandom(std::uint64_t seed)
    : state_(seed)
  {
  }
  double uniform() ///< 0 to 1
  {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return static_cast<double>((z ^ (z >> 31)) >> 11) * 0x1p-53;
  }

private:
  std::uint64_t state_;
};

/// Indices below `count`, ascending, with random steps of mean 1 / share.
std::vector<std::size_t> chosenIndices(std::size_t count, double share, std::uint64_t seed)
{
  std::vector<std::size_t> chosen;
  StepRandom random(seed);
  const double step = 1.0 / share;
  for (double at = random.uniform() * step; at < static_cast<double>(count);
       at += 1.0 + random.uniform() * 2.0 * (step - 1.0))
  {
    chosen.push_back(static_cast<std::size_t>(at));
  }
  return chosen;
}

/// The kept points of one original, one chunk for each of its chunks that was read.
class SampledSource final : public PointSource
{
public:
  SampledSource(SourceDescription description, std::vector<std::shared_ptr<const PointBatch>> kept)
    : description_(std::move(description))
    , kept_(std::move(kept))
  {
    description_.pointCount = 0;
    for (const auto& batch : kept_)
    {
      description_.pointCount += batch->size();
    }
  }
  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return kept_.size(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override { return kept_[chunk]->size(); }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    batch = *kept_[chunk];
    return {};
  }

private:
  SourceDescription description_;
  std::vector<std::shared_ptr<const PointBatch>> kept_;
};
} // namespace

void PointSample::keep(std::size_t source, std::uint64_t chunk,
  const SourceDescription& description, const PointBatch& batch, double share)
{
  const AttributeSchema& schema = description.schema;
  const std::uint64_t seed = source * 0xd1342543de82ef95ull + chunk;
  const std::vector<std::size_t> chosen = chosenIndices(batch.size(), share, seed);
  auto kept = std::make_shared<PointBatch>();
  kept->resize(chosen.size(), schema);
  for (std::size_t i = 0; i < chosen.size(); ++i)
  {
    kept->positions[i] = batch.steps.empty()
      ? batch.positions[chosen[i]]
      : description.grid->toWorld(GridPosition(batch.steps[chosen[i]]));
  }
  for (std::size_t c = 0; c < schema.size(); ++c)
  {
    const std::size_t bytes = schema[c].bytes();
    for (std::size_t i = 0; i < chosen.size(); ++i)
    {
      std::memcpy(
        kept->columns[c].data() + i * bytes, batch.columns[c].data() + chosen[i] * bytes, bytes);
    }
  }
  const std::lock_guard<std::mutex> lock(mutex_);
  std::shared_ptr<const PointBatch>& place = kept_[{ source, chunk }];
  points_ += kept->size() - (place ? place->size() : 0);
  place = std::move(kept);
}

void PointSample::clear()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  kept_.clear();
  points_ = 0;
}

std::uint64_t PointSample::points() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return points_;
}

PointSources PointSample::snapshot(
  const PointSources& originals, const MetadataRecord& metadata) const
{
  std::vector<std::vector<std::shared_ptr<const PointBatch>>> bySource(originals.size());
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const auto& [key, batch] : kept_)
    {
      bySource[key.first].push_back(batch);
    }
  }
  PointSources sources;
  for (std::size_t s = 0; s < originals.size(); ++s)
  {
    SourceDescription description = originals[s]->description();
    description.metadata.push_back(metadata);
    sources.push_back(
      std::make_unique<SampledSource>(std::move(description), std::move(bySource[s])));
  }
  return sources;
}

} // namespace pointfront
