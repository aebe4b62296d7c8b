#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Disk/ByteSource.h"
#include "pointfront/Store/NodeRanges.h"
#include "pointfront/Store/StoreFormat.h"
#include "pointfront/Store/StoreWriter.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// Two codes of a range (NodeRanges::Codes): the narrowest marks that enclose it. The marks ascend
/// and enclose it; an empty range has its low code after its high one.
void putRangeCodes(const ValueRange& range, const std::vector<double>& marks, std::uint8_t* codes);

/// Collects the ranges of payloads while they are written, and makes the section of them.
/// Memory   8 bytes a node and component, 16 for those of more than 16 bits that are not float32.
/// Threads  one.
class NodeRangesWriter
{
public:
  explicit NodeRangesWriter(const AttributeSchema& schema);

  /// Adds bounds and ranges of the points of the next payload.
  void add(const GridBounds& bounds, const std::vector<ColumnRange>& ranges);
  /// The section of a sound table; payloads[i] belongs to nodes[i].
  std::vector<std::byte> encode(
    const std::vector<Node>& nodes, const std::vector<std::uint32_t>& payloads) const;

private:
  std::vector<NodeIndex> filledNodes(
    const std::vector<Node>& nodes, const std::vector<std::uint32_t>& payloads) const;
  /// Low and high of each payload in turn; floats where they hold every value of the type.
  struct Values
  {
    bool narrow = false;
    std::vector<float> floats;
    std::vector<double> doubles;

    void add(const ValueRange& range);
    ValueRange at(std::uint32_t payload) const;
  };
  std::vector<Values> components_;
  std::vector<bool> filled_; ///< by payload: there is a range that is not empty
};

/// The section in a file: it is read only when somebody asks for it.
/// Threads  const functions from any thread; they wait for the disk.
class NodeRangesFile
{
public:
  NodeRangesFile(std::shared_ptr<const ByteSource> file, const SectionEntry& section,
    NodeIndex nodes, std::uint32_t components)
    : file_(std::move(file))
    , section_(section)
    , nodes_(nodes)
    , components_(components)
  {
  }

  /// Reads those of the first `most` nodes, or of all. Errors: Unreadable, Corrupt.
  Result<std::shared_ptr<const NodeRanges>> read(std::uint32_t component, NodeIndex most) const;

private:
  struct Part;
  Result<Part> find(std::uint32_t component) const;

  std::shared_ptr<const ByteSource> file_;
  SectionEntry section_;
  NodeIndex nodes_;
  std::uint32_t components_;
};

} // namespace pointfront
