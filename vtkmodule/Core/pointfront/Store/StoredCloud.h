#pragma once

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Progress.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Points/PointSource.h"
#include "pointfront/Points/QuantisationGrid.h"
#include "pointfront/Store/Hierarchy.h"
#include "pointfront/Store/NodeRanges.h"
#include "pointfront/Store/NodeReader.h"

#include <algorithm>
#include <array>
#include <cstdint>
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

/// Everything about a stored cloud except its points; `pointfront info` prints it.
struct StoreDescription
{
  std::string path;
  std::uint32_t version = 0;
  std::uint64_t fileBytes = 0;
  std::uint64_t pointCount = 0;
  /// Number of points in the cloud that it shows a part of: a first look, the preview of a running
  /// build, a tree that lacks points of its file. At most pointCount, as here: nothing is missing.
  std::uint64_t wholeCount = 0;
  Bounds bounds; ///< tight, of the stored points
  QuantisationGrid grid;
  std::string crsWkt;
  std::string structure; ///< "octree", "kdtree", "inplace", "tiles", "sample"
  Refinement refinement = Refinement::Add;
  std::uint32_t levels = 0;
  AttributeSchema schema;
  std::vector<ColumnRange> ranges; ///< one for each column
  /// The ranges are those of some points: others may lie beyond (files of others, read in place).
  /// certainRange() is what holds for all.
  bool rangesAreSampled = false;
  /// Columns, ascending, that no file holds: they are computed while a node is decoded, for those
  /// who name them. Who asks for all attributes does not mean these.
  ColumnSelection computed;
  std::vector<Layer> layers;
  std::vector<MetadataRecord> metadata;
  std::string generator; ///< "pointfront 0.1.0"
  /// Base of the codes in the column `splat_radius` (SplatRadius.h), world units; 0 if the store
  /// has no such column.
  double splatRadiusBase = 0.0;
  /// For a cloud that is made of others, or is a part of another: what differs or is left out, in
  /// full sentences.
  std::vector<std::string> warnings;
  /// A collection's: dates or names of its tiles' epochs, ascending; "" for tiles that have none.
  std::vector<std::string> epochs;
  /// A collection's, where each epoch has trees of its own: the computed column that tells the
  /// epoch of each point, and its values for `epochs`, in their order (EpochColumn).
  std::optional<std::uint32_t> epochColumn;
  std::vector<double> epochTimes;

  bool isComputed(std::size_t column) const
  {
    return std::find(computed.begin(), computed.end(), column) != computed.end();
  }
  /// False where nodes are counted when they are looked into: a layer has points and no nodes.
  bool knowsNodes() const
  {
    return std::none_of(layers.begin(), layers.end(),
      [](const Layer& layer) { return layer.pointCount > 0 && layer.nodeCount == 0; });
  }
  std::uint64_t missingPoints() const
  {
    return wholeCount > pointCount ? wholeCount - pointCount : 0;
  }
};

struct VerifyReport
{
  bool ok = true;
  std::uint64_t nodesChecked = 0;
  std::uint64_t pointsChecked = 0;
  std::string firstError; ///< names the node and the byte offset; empty when ok
};

/// A cloud on disk that can be drawn at once: a description, a node table and the nodes' points.
/// Drawing, exports and checks know no more than this interface. The cloud may be a store of ours
/// or an index over a file that someone else wrote.
/// Threads    all functions are safe from any thread.
class StoredCloud : public NodeReader
{
public:
  virtual const StoreDescription& description() const = 0;
  virtual const std::shared_ptr<const Hierarchy>& hierarchy() const = 0;
  /// Paths of the files whose bytes it is: itself, and what it refers to.
  virtual std::vector<std::string> files() const { return { description().path }; }

  /// Ranges of one component (rangeComponent) in the first `most` nodes of the table or more, or in
  /// all. Null where the cloud does not know them. May wait for the disk.
  virtual Result<std::shared_ptr<const NodeRanges>> nodeRanges(
    std::uint32_t component, NodeIndex most = noNode) const
  {
    static_cast<void>(component);
    static_cast<void>(most);
    return std::shared_ptr<const NodeRanges>();
  }

  /// Every checksum, count and invariant (tree shape, boxes enclose their points and children,
  /// sums of counts). Stops at the first broken one. Cancelled is the only Error.
  virtual Result<VerifyReport> verify(const ProgressFunction& progress = {}) const = 0;
};

/// Opens stored clouds of one kind.
class StoredCloudFormat
{
public:
  virtual ~StoredCloudFormat() = default;
  virtual std::string name() const = 0; ///< "store", "index of a LAS file"
  virtual bool accepts(const std::string& path) const = 0; ///< by content, cheap, silent
  virtual Result<std::shared_ptr<const StoredCloud>> open(const std::string& path) const = 0;
  /// The same, for who makes it a part of a larger cloud: the number of its nodes is known, and
  /// numbers of nodes and points have no gaps. A table that open() reads as it is looked into is
  /// read whole.
  virtual Result<std::shared_ptr<const StoredCloud>> openWhole(const std::string& path) const
  {
    return open(path);
  }
};

} // namespace pointfront
