#pragma once

#include "RasterMosaic.h"

#include "pointfront/Points/AttributePass.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

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
/// Memory   decoded tiles take an eighth of the limit (1 GiB at most), 10 MiB at least.
class RasterPass final : public AttributePass
{
public:
  RasterPass(std::vector<RasterInput> inputs, std::shared_ptr<const CoordinateSystems> systems);

  Result<PointSources> apply(
    PointSources sources, const PassResources& resources) const override;
  std::uint64_t heldBytes(const PassResources& resources) const override;
  std::vector<std::string> findings() const override;
  bool readsPoints() const override { return false; }

  /// What all sources share while they are read.
  struct Images;

private:
  std::vector<RasterInput> inputs_;
  std::shared_ptr<const CoordinateSystems> systems_;
  mutable std::shared_ptr<Images> images_; ///< of the last apply()
};

} // namespace pointfront

extern "C"
{
  /// Makes a RasterPass for a program that has loaded this library at run time; the caller owns it.
  pointfront::AttributePass* pointfrontMakeRasterPass(
    const std::vector<pointfront::RasterInput>& inputs,
    const std::shared_ptr<const pointfront::CoordinateSystems>& systems);
}
