#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Progress.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Points/PointSource.h"
#include "pointfront/Points/QuantisationGrid.h"
#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Store/NodeReader.h"

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// One object class with a tree of its own (or the single layer 0 of a store without layers).
struct Layer
{
  std::uint16_t objectClass = 0;
  std::string name; ///< "ground", "building" ...; "all" for the single layer
  std::uint64_t pointCount = 0;
  std::uint32_t nodeCount = 0;
};

/// Smallest and largest value of each component of a column, over the whole store, as stored
/// (before scale and offset). NaN components are left out.
struct ColumnRange
{
  std::vector<std::array<double, 2>> components;
};

/// What `pointfront info` prints: everything about a store but its points.
struct StoreDescription
{
  std::string path;
  std::uint32_t version = 0;
  std::uint64_t fileBytes = 0;
  std::uint64_t pointCount = 0;
  Bounds bounds; ///< tight, of the stored points
  QuantisationGrid grid;
  std::string crsWkt;
  std::string structure;   ///< "octree", "kdtree"
  Refinement refinement = Refinement::Add;
  std::uint32_t levels = 0;
  AttributeSchema schema;
  std::vector<ColumnRange> ranges; ///< one for each column
  std::vector<Layer> layers;
  std::vector<MetadataRecord> metadata;
  std::string generator; ///< "pointfront 0.1.0"
};

struct VerifyReport
{
  bool ok = true;
  std::uint64_t nodesChecked = 0;
  std::uint64_t pointsChecked = 0;
  std::string firstError; ///< names the node and the byte offset; empty when ok
};

/// A `.pfront` file, open for reading. The format: docs/formats/pfront.md.
/// Threads    all functions are safe from any thread (positional reads, no shared cursor).
/// Errors     open: NotFound, Unreadable, BadFormat (not a store), Unsupported (a newer version, or
///            made for other codecs), Truncated, Corrupt. read: Corrupt with node and byte offset.
class PointStore final : public NodeReader
{
public:
  static Result<std::shared_ptr<const PointStore>> open(const std::string& path);
  /// True if the file begins like a store of any version. Cheap, silent.
  static bool looksLikeStore(const std::string& path);
  ~PointStore() override;

  const StoreDescription& description() const;
  const std::shared_ptr<const Hierarchy>& hierarchy() const;

  Result<NodeColumns> read(NodeIndex node, const ColumnSelection& columns) const override;
  std::size_t decodedBytes(NodeIndex node, const ColumnSelection& columns) const override;
  std::size_t storedBytes(NodeIndex node, const ColumnSelection& columns) const override;

  /// Every checksum, count and invariant (tree shape, boxes enclose their points and children,
  /// sums of counts). Stops at the first broken one. Cancelled is the only Error.
  Result<VerifyReport> verify(const ProgressFunction& progress = {}) const;

private:
  PointStore();
  struct Content;
  std::unique_ptr<Content> content_;
};

} // namespace pointfront
