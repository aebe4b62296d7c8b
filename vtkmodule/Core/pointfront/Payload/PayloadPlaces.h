#pragma once

#include "pointfront/Disk/LatePieces.h"
#include "pointfront/Payload/BlockDirectory.h"
#include "pointfront/Payload/BufferedOutput.h"
#include "pointfront/Payload/ColumnPieces.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

/// A block of a node that is to be written.
struct BlockToWrite
{
  const std::byte* data = nullptr;
  std::uint32_t bytes = 0;
  std::uint32_t checksum = 0;
  BlockCodec codec = BlockCodec::Raw;
};

/// Gives the payloads of a store their places in its file, and writes them there.
/// Order    first pieces one after another. Second pieces wait until they come to a run of about
///          `runBytes`, which then follows the first pieces of their nodes. Behind all of these
///          come the second pieces of late nodes, and then their first ones, so that what lies
///          beside the tables are first pieces only. Places follow from the order of the calls
///          alone.
/// Copies   a copy has all payloads: what is not in the file yet comes with it, and goes to the
///          file that the copy is finished in.
/// Threads  one; others may use copies meanwhile.
/// Errors   those of OutputFile and of LatePieces.
class PayloadPlaces
{
public:
  static constexpr std::size_t runBytes = std::size_t(1) << 20;

  /// `folder` is for the temporary file of late payloads.
  PayloadPlaces(ColumnPieces pieces, std::string folder)
    : directory_(std::move(pieces))
    , late_(std::move(folder))
  {
  }

  /// The next node's blocks: positions, then the columns.
  Result<void> append(
    BufferedOutput& file, const GridPosition& origin, const std::vector<BlockToWrite>& blocks);
  /// The same for a node whose payload finish() writes.
  Result<void> appendLate(const GridPosition& origin, const std::vector<BlockToWrite>& blocks);
  /// Writes what waits. `order`: nodes; the late ones among them come in the opposite order.
  Result<void> finish(BufferedOutput& file, const std::vector<std::uint32_t>& order);

  /// All that has been written lies in another file than all that comes.
  void goElsewhere() { directory_.markElsewhere(); }

  /// Places are those in the file once finish() is done.
  const BlockDirectory& directory() const { return directory_; }

private:
  void take(
    std::uint64_t offset, const GridPosition& origin, const std::vector<BlockToWrite>& blocks);
  template <typename Put>
  Result<void> putPiece(
    std::size_t piece, const std::vector<BlockToWrite>& blocks, const Put& put) const;
  Result<void> putWaiting(BufferedOutput& file);

  BlockDirectory directory_;
  LatePieces late_; // by node: its first piece, then its second
  std::vector<std::uint32_t> waiting_; // nodes whose second pieces are in `waitingBytes_`
  std::vector<std::byte> waitingBytes_;
};

} // namespace pointfront
