#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Payload/PayloadPlaces.h"
#include "pointfront/Store/GridBounds.h"
#include "pointfront/Store/NodeReader.h"
#include "pointfront/Store/StoredCloud.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// The compressed payload of one node, ready to be appended: made by encodeNode() on any thread.
struct EncodedNode
{
  struct Block
  {
    std::vector<std::byte> bytes;
    std::uint8_t codec = 0;
    std::uint32_t checksum = 0; ///< checksum of `bytes`
  };
  Block positions;
  std::vector<Block> columns; ///< one for each column of the schema
  GridPosition origin{ 0 };
  std::uint32_t pointCount = 0;
  GridBounds bounds; ///< bounds of the points, not relative to the origin
  std::vector<ColumnRange> ranges; ///< range of the points, one for each column

  std::size_t bytes() const;
};

/// Compresses the columns of one node, which has at most 2^24 points. `points.selection` must name
/// every column of the schema.
/// Pure: the same points give the same bytes, on any thread.
EncodedNode encodeNode(const NodeColumns& points, const AttributeSchema& schema);

struct StoredPayload;

/// The one value that a column has in all points, of Attribute::bytes(); nothing: they differ.
using ColumnConstants = std::vector<std::optional<std::vector<std::byte>>>;
/// The same, with `constants` for each column; points.columns of constant ones may be empty.
EncodedNode encodeNode(
  const NodeColumns& points, const AttributeSchema& schema, const ColumnConstants& constants);

/// The payloads that a writer has written so far, for stores that refer to it.
struct WrittenPayloads
{
  std::string storeName; ///< file name of the store
  std::string nameMeanwhile; ///< the file's name while it is written
  std::uint64_t bytes = 0; ///< bytes of that file, to be relied on from now on
  PayloadPlaces places{ {}, {} }; ///< by PayloadId, with those of which that file has nothing yet
  std::vector<std::uint32_t> pointCounts; ///< likewise
  GridBounds bounds;
  std::vector<ColumnRange> ranges; ///< range of all their points, one for each column
};

/// Writes a store: payloads (PayloadPlaces.h), then the tables. Whole or absent: writes an
/// OutputFile, which commit() publishes; a writer that is destroyed without commit() removes it.
/// Threads  one thread.
/// Errors   Unwritable, with the bytes that were missing when the disk is full.
class StoreWriter
{
public:
  /// Bytes on disk of a node already appended.
  using PayloadId = std::uint32_t;

  static Result<std::unique_ptr<StoreWriter>> create(
    const std::string& path, const AttributeSchema& schema);
  /// A store that refers to payloads in the file of another writer: their ids are the same here,
  /// and commit() has to place them all. Nothing of it is made durable: it has a meaning only while
  /// the other writer lives. It must lie in the folder of the other store.
  static Result<std::unique_ptr<StoreWriter>> createReferring(
    const std::string& path, const AttributeSchema& schema, WrittenPayloads elsewhere);
  virtual ~StoreWriter() = default;

  /// Appends one node's payload; the id names it in commit().
  virtual Result<PayloadId> append(const EncodedNode& node) = 0;
  /// The same for a node near a root: its payload is written by commit(), beside the tables, so
  /// that who opens the store from afar gets it with them. Those of siblings lie side by side,
  /// those of roots last.
  virtual Result<PayloadId> appendLate(const EncodedNode& node) = 0;

  /// Appends the payload of a node of another store of the same schema as it lies there. The caller
  /// knows bounds and ranges of its points.
  virtual Result<PayloadId> append(const StoredPayload& payload, const GridBounds& bounds,
    const std::vector<ColumnRange>& ranges) = 0;

  /// `nodes` is the whole table, breadth first, children neighbours, `roots` ascending;
  /// payloads[i] belongs to nodes[i]; one without points may be that of several nodes.
  /// `description` gives grid, crs, structure, refinement,
  /// schema, generator, metadata, and class and name of the layers; counts, bounds, ranges and
  /// sizes are computed here from what was appended.
  /// Errors  Unwritable; BadArgument when the table is not a hierarchy or does not match the
  ///         payloads, with the node and the reason. The store is then not written.
  virtual Result<void> commit(StoreDescription description, const std::vector<Node>& nodes,
    const std::vector<NodeIndex>& roots, const std::vector<PayloadId>& payloads) = 0;

  virtual std::uint64_t bytesWritten() const = 0;

  /// All that was appended, readable in the file from now on, and for as long as somebody has the
  /// file open, also after commit().
  virtual Result<WrittenPayloads> written() = 0;
};

} // namespace pointfront
