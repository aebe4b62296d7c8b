#pragma once

#include "RasterFile.h"
#include "RasterTiles.h"

#include "pointfront/Base/Result.h"

#include <glm/vec3.hpp>

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// Several images that cover the ground together.
/// Nearest   the pixel that a point lies in: no interpolation.
/// Overlaps  the first image named wins; where it has no data, the next.
/// Order     the points asked for are sorted by tile, and each tile is fetched once for all of
///           them (TEXTURE-1: "the cloud is sorted by the tiles of the aerial images").
/// Threads   open() from one, sample() from any.
class RasterMosaic
{
public:
  /// `tiles` must outlive this.
  /// Errors  those of RasterFile::open() and RasterTiles::add(); BadArgument: images of which the
  ///         channels or their type differ, for RasterUse::Values.
  static Result<RasterMosaic> open(const std::vector<std::string>& paths, RasterUse use,
    const CoordinateSystems& systems, RasterTiles& tiles);

  const std::vector<RasterFile>& files() const { return files_; }

  /// The way from the points' system to that of each group of images; null: the same.
  using Ways = std::vector<std::shared_ptr<const CoordinateTransform>>;
  /// One image of each group of images in one system, in the order of Ways.
  std::vector<std::size_t> groupLeaders() const;

  /// Gets a point's number and its pixel, all channels. False: this pixel says nothing; the next
  /// image is asked.
  using Visit = std::function<bool(std::size_t point, const RasterFile& file, const std::byte*)>;
  /// `positions` in the points' own system. Gives the number of points that no pixel was taken for.
  Result<std::uint64_t> sample(
    const std::vector<glm::dvec3>& positions, const Ways& ways, const Visit& visit) const;

  /// A number of tiles, and their bytes decoded.
  struct Tiles
  {
    std::uint64_t count = 0;
    std::uint64_t bytes = 0;
  };
  /// All of all images.
  Tiles tiles() const;
  /// Those that hold the first pixel of any of the points.
  Result<Tiles> tilesOf(const std::vector<glm::dvec3>& positions, const Ways& ways) const;

private:
  /// The images of one system and where to look for them: a lattice of cells over their extent,
  /// each with the images that touch it, in the order in which they were named.
  struct Group
  {
    std::vector<std::uint32_t> images;
    Bounds ground;
    glm::dvec2 cell{ 1.0 };
    int across = 1;
    int down = 1;
    std::vector<std::vector<std::uint32_t>> touching;
  };
  /// A point's pixel.
  struct Hit
  {
    std::uint32_t image = 0;
    std::uint32_t tile = 0;
    std::uint32_t point = 0;
    std::uint32_t pixel = 0; ///< in the tile, row by row
  };

  void group();
  bool find(const Group& group, const glm::dvec3& p, std::uint32_t from, Hit& hit) const;
  std::optional<Hit> firstHit(const std::vector<glm::dvec3>& positions,
    const std::vector<std::vector<glm::dvec3>>& moved, std::size_t point, std::uint32_t from) const;
  std::uint64_t tileBytes(std::uint32_t image) const;
  Result<void> visitHits(
    const std::vector<Hit>& hits, const Visit& visit, std::vector<std::uint32_t>& refused) const;
  Result<std::vector<std::vector<glm::dvec3>>> positionsOf(
    const std::vector<glm::dvec3>& positions, const Ways& ways) const;

  RasterTiles* tiles_ = nullptr;
  std::vector<RasterFile> files_;
  std::vector<std::uint32_t> numbers_; ///< numbers of the files in tiles_
  std::vector<Group> groups_;
};

} // namespace pointfront
