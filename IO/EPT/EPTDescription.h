#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Points/QuantisationGrid.h"
#include "pointfront/Points/ScalarType.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace pointfront
{

/// How the nodes of an Entwine tree hold their points.
enum class EPTEncoding
{
  Laszip, ///< a LAZ file each
  Binary, ///< records of the schema
  Zstandard ///< the same, as one zstd frame
};

/// A number of every record.
struct EPTDimension
{
  std::string name;
  ScalarType type = ScalarType::Int32;
  double scale = 1.0;
  double offset = 0.0;
};

/// The text of an ept.json.
/// Source  "Entwine Point Tile", entwine.io, version 1.1.0.
struct EPTDescription
{
  EPTEncoding encoding = EPTEncoding::Laszip;
  std::vector<EPTDimension> dimensions;
  Bounds bounds; ///< box of the points, as the file says
  Bounds cube; ///< cell of the root
  double ticks = 0.0; ///< points along a side of a cell ("span"); 0: not said
  std::uint64_t points = 0;
  std::string wkt; ///< or a code, or a PROJ string; empty: not known
  std::string version;

  std::size_t recordBytes() const;
  /// That of X, Y and Z if they are integers.
  std::optional<QuantisationGrid> grid() const;
  /// Errors  BadFormat; Unsupported: an encoding or a hierarchy of another kind. With `path`.
  static Result<EPTDescription> parse(std::string_view text, const std::string& path);
};

/// A page of the hierarchy: "D-X-Y-Z" -> points of that node, -1: a page of its own.
using EPTPage = std::map<std::string, std::int64_t>;
/// Errors  BadFormat with `path`: no JSON, keys or counts that are none.
Result<EPTPage> parseEPTPage(std::string_view text, const std::string& path);

/// A node with points.
struct EPTNode
{
  std::string key;
  std::uint32_t points = 0;
};

/// A hierarchy as far as it was read.
struct EPTHierarchy
{
  std::vector<EPTNode> nodes; ///< those with points, sorted by their keys
  std::vector<std::string> pages; ///< keys of pages that were not read
};
enum class EPTDepth
{
  Whole,
  FirstPoints ///< the first page, few that it refers to, and on to one that has a node with points
};
/// The hierarchy beside the ept.json at `path`. Pages of one level are read together. `first`: the
/// text of its first page, if that was read already.
/// Errors  of its pages: NotFound, Unreadable, BadFormat (a page that refers to itself, more points
///         in a node than its file could have).
Result<EPTHierarchy> readEPTHierarchy(
  const std::string& path, EPTDepth depth, std::optional<std::string> first = std::nullopt);
/// Some of its pages, by their keys, together. Errors  each its own, as above.
std::vector<Result<EPTPage>> readEPTPages(
  const std::string& path, const std::vector<std::string>& keys);

/// The place of the hierarchy's first page, and of others by their keys.
std::string pathOfEPTPage(const std::string& path, const std::string& key = "0-0-0-0");
/// No page has more.
constexpr std::uint64_t mostEPTPageBytes = std::uint64_t(256) << 20; ///< ten million nodes

} // namespace pointfront
