#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Result.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pointfront
{

/// A file of points, and the facts that the item tells about it.
struct STACItem
{
  std::string name; ///< its id; for messages
  std::string href; ///< as it stands there
  std::optional<Bounds> bounds; ///< proj:bbox; in the file's own coordinate reference system
  std::optional<std::uint64_t> points; ///< pc:count
  std::string system; ///< proj:wkt2, proj:projjson, proj:code or proj:epsg, as it stands there
  std::string kind; ///< pc:schemas, as it stands there: equal for files with the same attributes
};

/// The items of a STAC ItemCollection, one file of points for each.
/// Files    of an item the one that is read in place (COPC, EPT, a store), else the one that its
///          role calls data; no overview.
/// Height   of a box in the plane is that of pc:statistics.
/// Source   STAC 1.0 with the extensions pointcloud and projection; PDAL wrench, vpc-spec.md.
struct ItemCollection
{
  std::vector<STACItem> items;
  std::vector<std::string> warnings; ///< items without points; that there are more pages

  /// `path` is for messages.
  /// Errors  BadFormat: no JSON, no ItemCollection, no item with a file of points, or a value that
  ///         cannot be what its name says.
  static Result<ItemCollection> parse(std::string_view text, const std::string& path);
};

/// The path or address that an item's href means in the list at `path`, as a browser would take it.
/// In a list on a disk, a path that is not there as it is written is taken as a URI ("%20"). A list
/// behind an address names addresses only. Errors  Unsupported: an address with settings
/// (FarSettings); a file of this machine, and the list lies behind an address.
Result<std::string> resolvedHref(const std::string& path, const std::string& href);

} // namespace pointfront
