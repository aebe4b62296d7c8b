#pragma once

#include "RasterFile.h"

#include "pointfront/Base/Result.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace pointfront
{

/// The tiles of many images, of which a bounded number is in memory: OpenImageIO's ImageCache.
/// Pixels are as in the file, whatever their type. The cache itself keeps 8 and 16 unsigned bits
/// and float only, and would turn all else into float; such images are shown to it as bytes.
/// Images without tiles are read by bands of 128 rows.
/// Threads   add() from one thread, first; tile() from any.
class RasterTiles
{
public:
  /// `bytes`: most memory for tiles; OpenImageIO takes at least 10 MiB.
  explicit RasterTiles(std::uint64_t bytes);
  ~RasterTiles();
  RasterTiles(const RasterTiles&) = delete;
  RasterTiles& operator=(const RasterTiles&) = delete;

  /// How an image is cut into tiles, pixels.
  struct Layout
  {
    int width = 1; ///< width of a tile
    int height = 1;
    int across = 1; ///< tiles in a row
  };
  /// Gives the image its number, from 0. Errors: those of opening it.
  Result<std::uint32_t> add(const RasterFile& file);
  const Layout& layout(std::uint32_t image) const;

  /// One tile, kept in memory while this lives: rows of layout().width pixels.
  class Tile
  {
  public:
    Tile(const RasterTiles& tiles, void* handle, const std::byte* pixels)
      : tiles_(&tiles)
      , handle_(handle)
      , pixels_(pixels)
    {
    }
    ~Tile();
    Tile(Tile&& other) noexcept;
    Tile& operator=(Tile&&) = delete;
    const std::byte* pixels() const { return pixels_; }

  private:
    const RasterTiles* tiles_;
    void* handle_;
    const std::byte* pixels_;
  };
  /// The tile that holds a pixel. Error BadFormat with the path: it cannot be decoded.
  Result<Tile> tile(std::uint32_t image, int column, int row) const;

  /// Tiles decoded so far, those decoded again included.
  std::uint64_t tilesRead() const;
  /// Memory that tiles take now.
  std::uint64_t bytesUsed() const;

private:
  struct Cache;
  std::unique_ptr<Cache> cache_;
};

} // namespace pointfront
