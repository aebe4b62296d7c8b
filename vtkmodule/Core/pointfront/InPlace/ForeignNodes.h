#pragma once

#include "pointfront/Base/RawBytes.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Disk/ByteSource.h"
#include "pointfront/Points/PointSource.h"
#include "pointfront/Store/NodeReader.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// A node of an octree that somebody else wrote. Cell x, y, z of 2^level cells along each side of
/// the root's cube.
struct ForeignNode
{
  std::int32_t level = 0;
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t z = 0;
  std::uint32_t points = 0;
  /// Where its points are, or its page, for a reader that does not know them by the cell.
  std::uint64_t offset = 0;
  std::uint32_t bytes = 0;
};

/// A part of such a tree's hierarchy.
struct ForeignPage
{
  std::vector<ForeignNode> nodes; ///< in any order
  /// Cells of which a page of their own tells them and all below; `points` has no meaning.
  std::vector<ForeignNode> pages;
};

/// Reads the nodes of such a tree, and those pages of its hierarchy that were not read when it was
/// opened. Threads  all functions from any thread.
class ForeignNodes
{
public:
  virtual ~ForeignNodes() = default;
  /// Bytes of a node's points as they lie on the disk.
  virtual Result<RawBytes> fetch(const ForeignNode& node) const = 0;
  /// Several, in as few round trips as possible; one after the other if there is no better way.
  virtual std::vector<Result<RawBytes>> fetchAll(
    const std::vector<ForeignNode>& nodes, const ReadStop& stop) const;
  virtual std::size_t storedBytes(const ForeignNode& node) const = 0;
  /// Where a node's bytes begin, if all nodes lie in one file.
  virtual std::optional<std::uint64_t> place(const ForeignNode&) const { return std::nullopt; }
  /// The part of a node that is wanted.
  struct Part
  {
    const ForeignNode& node;
    std::uint32_t first = 0; ///< so many of its points are enough, those that come first
    const ColumnSelection& columns;
  };
  /// Points in the file's order, as positions or as steps, with the wanted columns. Other columns
  /// may be filled or empty.
  virtual Result<void> decode(const Part& part, const RawBytes& bytes, PointBatch& batch) const = 0;
  /// Pages of the hierarchy by the entries that refer to them, in as few round trips as possible.
  /// Errors  Unsupported: a reader of trees that were read whole.
  virtual std::vector<Result<ForeignPage>> readPages(const std::vector<ForeignNode>& pages) const;
  virtual std::uint64_t disk() const { return 0; }
  virtual ReadCost readCost() const { return {}; }
  virtual std::vector<std::string> files() const = 0;
};

} // namespace pointfront
