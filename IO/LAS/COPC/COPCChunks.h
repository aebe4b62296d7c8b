#pragma once

#include "COPCMemory.h"
#include "COPCPages.h"
#include "LASPointLayout.h"
#include "LASzipWriter.h"

#include "pointfront/Base/Result.h"
#include "pointfront/Disk/LatePieces.h"
#include "pointfront/Disk/OutputFile.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <future>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// Writes the nodes of an octree, each as one LAZ chunk, to the end of a file. Points come in an
/// order in which the points of every cell follow each other; a leaf is written when its cell ends.
/// Order    leaves as they come, then all other nodes, the deepest level first and the root last: a
///          view wants nodes of one level that are neighbours, and one read brings several.
/// Memory   a node of up to memory.nodeBytes is compressed as a whole, on another thread; a larger
///          one while its points come, as its compressed bytes. Open are one node of each level and
///          as many as there are threads.
/// Threads  one thread calls.
class COPCChunks
{
public:
  static constexpr std::size_t levels = 16; ///< 0 to 15
  static constexpr std::size_t rawBytes = std::size_t{ 2 } << 20; ///< nodeBytes, at most

  /// The file's end is at `offset`; nodes wait in an unnamed file in `temporaryFolder`. All that is
  /// referred to outlives this.
  COPCChunks(const LASPointLayout& layout, const std::string& path, OutputFile& file,
    std::uint64_t offset, const COPCMemory& memory, std::string temporaryFolder);

  /// Nodes from this level on have no further points.
  Result<void> close(int level);
  /// A point of the node of that level and cell.
  Result<void> add(int level, const glm::uvec3& cell, const std::byte* record);
  /// After close(0): all chunks are in the file.
  Result<void> settle();

  std::vector<COPCNode>& nodes() { return nodes_; }
  std::uint64_t end() const { return end_; } ///< the byte behind the last chunk
  /// The chunk table of the file, in the order of the chunks.
  std::vector<std::byte> table() const;

private:
  using Chunk = Result<std::vector<std::byte>>;
  struct Open
  {
    bool exists = false;
    bool inner = false; ///< has children
    glm::uvec3 cell{ 0 };
    std::uint32_t points = 0;
    std::vector<std::byte> raw; ///< records, while they are few
    std::optional<LASzipWriter> laszip; ///< instead
  };
  struct Pending
  {
    COPCNode node;
    bool inner = false;
    std::future<Chunk> chunk;
  };

  Result<void> compressMeanwhile(Open& open, const std::byte* records, std::size_t count);
  /// Writes chunks in their order until at most `left` are being compressed.
  Result<void> writeUntil(std::size_t left);
  /// Appends the chunk of a node to the file.
  Result<void> write(std::size_t node, const std::vector<std::byte>& chunk);

  const LASPointLayout& layout_;
  std::string path_;
  OutputFile& file_;
  std::uint64_t end_;
  std::size_t nodeBytes_;
  std::size_t threads_;
  std::array<Open, levels> open_;
  std::deque<Pending> pending_;
  LatePieces late_; ///< chunks of inner nodes, by their place in nodes_
  std::vector<COPCNode> nodes_;
  std::vector<std::size_t> chunks_; ///< nodes that have one, in the order of the file
};

} // namespace pointfront
