#include "pointfront/Payload/PayloadPlaces.h"

#include <cassert>

namespace pointfront
{

void PayloadPlaces::take(
  std::uint64_t offset, const GridPosition& origin, const std::vector<BlockToWrite>& blocks)
{
  assert(blocks.size() == directory_.blocksPerNode());
  directory_.addNode(origin, offset);
  for (const BlockToWrite& block : blocks)
  {
    directory_.addBlock(block.bytes, block.checksum, block.codec);
  }
}

template <typename Put>
Result<void> PayloadPlaces::putPiece(
  std::size_t piece, const std::vector<BlockToWrite>& blocks, const Put& put) const
{
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    if (directory_.pieceOf(b) != piece)
    {
      continue;
    }
    if (Result<void> done = put(blocks[b].data, blocks[b].bytes); !done)
    {
      return done;
    }
  }
  return {};
}

Result<void> PayloadPlaces::append(
  BufferedOutput& file, const GridPosition& origin, const std::vector<BlockToWrite>& blocks)
{
  const std::uint32_t node = directory_.nodeCount();
  take(file.end(), origin, blocks);
  const auto toFile = [&file](const std::byte* data, std::size_t size)
  { return file.put(data, size); };
  Result<void> done = putPiece(0, blocks, toFile);
  const std::uint64_t second = directory_.pieceBytes(node, 1);
  if (!done || second == 0)
  {
    return done;
  }
  if (waitingBytes_.size() + second < runBytes)
  {
    waitingBytes_.reserve(runBytes);
    waiting_.push_back(node);
    return putPiece(1, blocks,
      [this](const std::byte* data, std::size_t size) -> Result<void>
      {
        waitingBytes_.insert(waitingBytes_.end(), data, data + size);
        return {};
      });
  }
  done = putWaiting(file);
  directory_.setOffset(node, 1, file.end());
  return done ? putPiece(1, blocks, toFile) : done;
}

Result<void> PayloadPlaces::appendLate(
  const GridPosition& origin, const std::vector<BlockToWrite>& blocks)
{
  late_.begin(directory_.nodeCount());
  take(0, origin, blocks); // finish() knows better
  const auto later = [this](const std::byte* data, std::size_t size)
  { return late_.append(data, size); };
  const Result<void> done = putPiece(0, blocks, later);
  return done ? putPiece(1, blocks, later) : done;
}

Result<void> PayloadPlaces::putWaiting(BufferedOutput& file)
{
  std::uint64_t at = file.end();
  for (const std::uint32_t node : waiting_)
  {
    directory_.setOffset(node, 1, at);
    at += directory_.pieceBytes(node, 1);
  }
  Result<void> done = file.put(waitingBytes_);
  waiting_.clear();
  waitingBytes_.clear();
  return done;
}

Result<void> PayloadPlaces::finish(BufferedOutput& file, const std::vector<std::uint32_t>& order)
{
  if (Result<void> done = putWaiting(file); !done)
  {
    return done;
  }
  for (std::size_t piece = payloadPieces; piece-- > 0;)
  {
    for (auto node = order.rbegin(); node != order.rend(); ++node)
    {
      if (!late_.contains(*node))
      {
        continue;
      }
      const std::uint64_t begin = piece == 0 ? 0 : directory_.pieceBytes(*node, 0);
      const auto bytes =
        late_.read(*node, begin, static_cast<std::size_t>(directory_.pieceBytes(*node, piece)));
      directory_.setOffset(*node, piece, file.end());
      if (Result<void> done = bytes ? file.put(*bytes) : Result<void>(bytes.error()); !done)
      {
        return done;
      }
    }
  }
  return {};
}

} // namespace pointfront
