#pragma once

#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Tiles/CollectedTile.h"
#include "pointfront/Tiles/TileColumns.h"
#include "pointfront/Tiles/TilePlacing.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

/// Describes several stores as one cloud, and the change that each of them needs for that. From
/// their descriptions alone; nothing is read.
struct TileDescription
{
  /// How one of them becomes a part of the whole.
  struct Part
  {
    TileColumns columns;
    TilePlacing placing;
    std::vector<std::uint16_t> layers; ///< which of the common ones its own are
  };

  StoreDescription whole; ///< its warnings name the differences
  std::vector<Part> parts;

  /// `path` names the whole.
  /// Errors  BadArgument: tiles with subsets beside tiles with representatives; columns of one name
  ///         with different numbers of components.
  static Result<TileDescription> of(const std::string& path,
    const std::vector<const StoreDescription*>& tiles, std::vector<std::string> warnings);
  /// The same, where those without points have no say: their attributes, steps, systems, layers and
  /// refinement are nobody's, unless no store has points.
  static Result<TileDescription> ofStores(const std::string& path,
    const std::vector<const StoreDescription*>& tiles, std::vector<std::string> warnings);
  /// As of(), of many tiles of few kinds, by the kinds in the order in which tiles have them first;
  /// `grids` are those of all tiles. A part is that of the first tile of its kind: others have
  /// placings of their own.
  static Result<TileDescription> of(const std::string& path, const std::vector<AlikeTiles>& kinds,
    const std::vector<QuantisationGrid>& grids, std::vector<std::string> warnings);
};

/// A cloud's word about its coordinate reference system: WKT, or the bytes of LAS records; empty:
/// nothing.
std::string projectionOf(const StoreDescription& store);

} // namespace pointfront
