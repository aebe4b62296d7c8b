#pragma once

#include "RasterMosaic.h"

#include "pointfront/Points/AttributePass.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

struct RasterSourceInput;

/// An attribute and the images that it is taken from, in the order of their right of way.
struct RasterInput
{
  std::string attribute; ///< "rgb": colours; any other name: the values as they are
  std::vector<std::string> images;
};

/// Gives points colours (TEXTURE-1) and thematic values (TEXTURE-2) from georeferenced images.
/// Outside  points that no image has data for keep what they had; 0 where a source has no such
///          attribute. findings() counts them.
/// Systems  where a source and an image name different coordinate reference systems, points are
///          transformed for the lookup; where one names none, they are taken to be the same, with
///          a warning.
/// Order    points are looked up while they are read, those of a chunk sorted by image tile. Where
///          chunks are so scattered that the cache would thrash, apply() looks all of them up,
///          sorted by place (SortedRasterValues). The values are the same.
/// Memory   decoded tiles take an eighth of the limit (1 GiB at most), 10 MiB at least.
class ImageValuesPass final : public AttributePass
{
public:
  ImageValuesPass(
    std::vector<RasterInput> inputs, std::shared_ptr<const CoordinateSystems> systems);

  Result<PointSources> apply(PointSources sources, const PassResources& resources) const override;
  std::uint64_t heldBytes(const PassResources& resources) const override;
  std::vector<std::string> findings() const override;
  std::vector<std::string> filesRead() const override;
  bool readsPoints() const override { return false; } ///< but for scattered clouds and colours
  /// Tiles decoded for the sources of the last apply() so far, those decoded again included.
  std::uint64_t tilesRead() const;

  /// State that all sources share while they are read.
  struct Images;

private:
  using Inputs = std::vector<std::vector<RasterSourceInput>>; ///< the images of each source
  Result<PointSources> wrapped(PointSources sources, Inputs inputs,
    std::vector<AttributeSchema> schemas, const PassResources& resources) const;

  std::vector<RasterInput> inputs_;
  std::shared_ptr<const CoordinateSystems> systems_;
  mutable std::shared_ptr<Images> images_; ///< the images of the last apply()
};

} // namespace pointfront

extern "C"
{
  /// Makes a ImageValuesPass for a program that has loaded this library at run time; the caller
  /// owns it.
  pointfront::AttributePass* pointfrontMakeRasterPass(
    const std::vector<pointfront::RasterInput>& inputs,
    const std::shared_ptr<const pointfront::CoordinateSystems>& systems);
}
