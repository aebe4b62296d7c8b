#include "ImageValuesPass.h"

#include "RasterImages.h"
#include "RasterSource.h"
#include "SortedRasterValues.h"

#include <algorithm>
#include <map>
#include <unistd.h>
#include <utility>

namespace pointfront
{
namespace
{
std::uint64_t machineMemory()
{
  return static_cast<std::uint64_t>(::sysconf(_SC_PHYS_PAGES)) *
    static_cast<std::uint64_t>(::sysconf(_SC_PAGESIZE));
}

/// The ways from systems of points to systems of images, each made once.
class Ways
{
public:
  explicit Ways(const CoordinateSystems& systems)
    : systems_(systems)
  {
  }

  Result<RasterMosaic::Ways> to(
    const RasterMosaic& mosaic, const SourceDescription& source, std::vector<std::string>& warnings)
  {
    RasterMosaic::Ways ways;
    for (const std::size_t leader : mosaic.groupLeaders())
    {
      const RasterFile& file = mosaic.files()[leader];
      if (!file.system || source.crsWkt.empty())
      {
        tellOfUnknown(file, source, warnings);
        ways.push_back(nullptr);
        continue;
      }
      auto way = one(file, source, warnings);
      if (!way)
      {
        return way.error();
      }
      ways.push_back(*way);
    }
    return ways;
  }

private:
  using Transform = std::shared_ptr<const CoordinateTransform>;

  void tellOfUnknown(const RasterFile& file, const SourceDescription& source,
    std::vector<std::string>& warnings) const
  {
    if (file.system)
    {
      warnings.push_back(source.path + ": names no coordinate reference system; its points are " +
        "taken to be in that of the images, " + file.system->name + ".");
    }
    else
    {
      warnings.push_back(file.path + ": names no coordinate reference system" +
        (file.systemDoubt.empty() ? "" : " (" + file.systemDoubt + ")") +
        "; it is taken to be that of the points.");
    }
  }

  Result<Transform> one(
    const RasterFile& file, const SourceDescription& source, std::vector<std::string>& warnings)
  {
    const auto key = std::make_pair(source.crsWkt, file.system->wkt);
    const auto known = made_.find(key);
    if (known != made_.end())
    {
      return known->second;
    }
    const Result<CoordinateSystem> own = systems_.parse(source.crsWkt);
    if (!own)
    {
      return makeError(own.error().kind, source.path + ": " + own.error().what);
    }
    Transform way;
    if (!systems_.equivalent(*own, *file.system, true))
    {
      Result<std::unique_ptr<CoordinateTransform>> transform =
        systems_.transform(*own, *file.system, source.declaredBounds);
      if (!transform)
      {
        return makeError(transform.error().kind, file.path + ": " + transform.error().what);
      }
      way = std::move(*transform);
      warnings.insert(warnings.end(), way->warnings().begin(), way->warnings().end());
    }
    made_[key] = way;
    return way;
  }

  const CoordinateSystems& systems_;
  std::map<std::pair<std::string, std::string>, Transform> made_;
};

std::string counted(std::uint64_t count, std::uint64_t of)
{
  return std::to_string(count) + " of " + std::to_string(of) + " points";
}
} // namespace

ImageValuesPass::ImageValuesPass(
  std::vector<RasterInput> inputs, std::shared_ptr<const CoordinateSystems> systems)
  : inputs_(std::move(inputs))
  , systems_(std::move(systems))
{
}

std::uint64_t ImageValuesPass::heldBytes(const PassResources& resources) const
{
  constexpr std::uint64_t least = 10u << 20;
  constexpr std::uint64_t most = 1u << 30;
  const std::uint64_t memory =
    resources.memoryBytes > 0 ? resources.memoryBytes : machineMemory() / 2;
  return std::clamp(memory / 8, least, most);
}

Result<PointSources> ImageValuesPass::apply(
  PointSources sources, const PassResources& resources) const
{
  images_ = std::make_shared<Images>(heldBytes(resources));
  for (const RasterInput& input : inputs_)
  {
    const bool colour = input.attribute == "rgb";
    Result<RasterMosaic> mosaic = RasterMosaic::open(
      input.images, colour ? RasterUse::Colour : RasterUse::Values, *systems_, images_->tiles);
    if (!mosaic)
    {
      return mosaic.error();
    }
    images_->mosaics.push_back(std::move(*mosaic));
    images_->tallies.push_back(std::make_unique<RasterTally>());
  }
  Ways ways(*systems_);
  Inputs inputs;
  std::vector<AttributeSchema> schemas;
  for (const std::unique_ptr<PointSource>& source : sources)
  {
    AttributeSchema schema = source->description().schema;
    for (std::uint64_t chunk = 0; chunk < source->chunkCount(); ++chunk)
    {
      images_->points += source->chunkPoints(chunk);
    }
    std::vector<RasterSource::Input> own;
    for (std::size_t i = 0; i < inputs_.size(); ++i)
    {
      const RasterMosaic& mosaic = images_->mosaics[i];
      Result<RasterColumn> column =
        RasterColumn::make(inputs_[i].attribute, mosaic.files(), *source, resources);
      if (!column)
      {
        return column.error();
      }
      Result<RasterMosaic::Ways> way = ways.to(mosaic, source->description(), images_->warnings);
      if (!way)
      {
        return way.error();
      }
      if (!column->isOld())
      {
        schema.add(column->attribute());
      }
      const std::size_t target = *schema.find(inputs_[i].attribute);
      own.push_back({ std::move(*column), target, std::move(*way) });
    }
    inputs.push_back(std::move(own));
    schemas.push_back(std::move(schema));
  }
  return wrapped(std::move(sources), std::move(inputs), std::move(schemas), resources);
}

Result<PointSources> ImageValuesPass::wrapped(PointSources sources, Inputs inputs,
  std::vector<AttributeSchema> schemas, const PassResources& resources) const
{
  std::shared_ptr<const SortedRasterValues> sorted;
  const Result<bool> scattered =
    SortedRasterValues::areNeeded(sources, inputs, *images_, resources);
  if (!scattered)
  {
    return scattered.error();
  }
  if (*scattered)
  {
    auto values = SortedRasterValues::compute(sources, inputs, *images_, resources);
    if (!values)
    {
      return values.error();
    }
    sorted = std::move(*values);
  }
  for (std::size_t s = 0; s < sources.size(); ++s)
  {
    auto source = std::make_unique<RasterSource>(
      std::move(sources[s]), images_, std::move(inputs[s]), std::move(schemas[s]));
    source->use(sorted, s);
    sources[s] = std::move(source);
  }
  return sources;
}

std::uint64_t ImageValuesPass::tilesRead() const
{
  return images_ ? images_->tiles.tilesRead() : 0;
}

std::vector<std::string> ImageValuesPass::filesRead() const
{
  std::vector<std::string> files;
  for (const RasterInput& input : inputs_)
  {
    files.insert(files.end(), input.images.begin(), input.images.end());
  }
  return files;
}

std::vector<std::string> ImageValuesPass::findings() const
{
  if (!images_)
  {
    return {};
  }
  std::vector<std::string> sentences = images_->warnings;
  for (std::size_t i = 0; i < images_->tallies.size(); ++i)
  {
    const RasterTally& tally = *images_->tallies[i];
    if (tally.seen < images_->points)
    {
      continue; // a sample of the points is no count
    }
    if (tally.without > 0)
    {
      sentences.push_back(counted(tally.without, tally.seen) + " lie where no image has data for " +
        inputs_[i].attribute + ": they keep what they had, 0 if that was nothing.");
    }
    if (tally.notHeld > 0)
    {
      sentences.push_back(counted(tally.notHeld, tally.seen) + " would get values for " +
        inputs_[i].attribute + " that its type cannot hold: they keep what they had.");
    }
  }
  return sentences;
}

} // namespace pointfront

pointfront::AttributePass* pointfrontMakeRasterPass(
  const std::vector<pointfront::RasterInput>& inputs,
  const std::shared_ptr<const pointfront::CoordinateSystems>& systems)
{
  return new pointfront::ImageValuesPass(inputs, systems);
}
