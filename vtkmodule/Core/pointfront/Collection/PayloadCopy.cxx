#include "pointfront/Collection/PayloadCopy.h"

#include "pointfront/Codec/Checksum.h"
#include "pointfront/Store/StoreContent.h"

#include <algorithm>
#include <cassert>
#include <cstring>
#include <numeric>
#include <string>
#include <utility>

namespace pointfront
{
namespace
{
/// Bytes that are read at once.
constexpr std::uint64_t pieceBytes = std::uint64_t(1) << 20;
} // namespace

Result<const std::byte*> PayloadCopy::at(Piece& piece, std::uint64_t offset, std::size_t size) const
{
  const bool here = offset >= piece.begin && offset - piece.begin <= piece.size &&
    size <= piece.size - (offset - piece.begin);
  if (!here)
  {
    const ByteSource& file = *store_.content_->file;
    const std::uint64_t behind = file.bytes() - std::min(offset, file.bytes());
    piece.begin = offset;
    piece.size = std::max(size, static_cast<std::size_t>(std::min(behind, pieceBytes)));
    if (piece.room.size < piece.size)
    {
      piece.room = RawBytes(piece.size);
    }
    if (Result<void> done = file.readAt(offset, piece.room.data.get(), piece.size); !done)
    {
      piece.size = 0;
      return done.error();
    }
  }
  return piece.room.data.get() + (offset - piece.begin);
}

Result<StoredPayload> PayloadCopy::of(NodeIndex node, std::uint32_t points)
{
  const PointStore::Content& content = *store_.content_;
  std::vector<ByteRange> reads;
  const RawBytes record = content.directory->prepare(node, points, reads);
  for (const ByteRange& read : reads)
  {
    const Result<const std::byte*> bytes = at(records_, read.offset, read.size);
    if (!bytes)
    {
      return bytes.error();
    }
    std::memcpy(read.target, *bytes, read.size);
  }
  Result<NodePayload> payload = content.directory->decode(node, record);
  if (!payload)
  {
    return payload.error();
  }
  ColumnSelection all(payload->blocks.size() - 1);
  std::iota(all.begin(), all.end(), 0);
  const BlockRuns runs(*payload, all);
  assert(runs.runs.size() <= payloads_.size());
  std::vector<const std::byte*> found(payload->blocks.size());
  for (std::size_t r = 0; r < runs.runs.size(); ++r)
  {
    const BlockRuns::Run& run = runs.runs[r];
    assert(!run.elsewhere);
    const Result<const std::byte*> bytes = at(payloads_[r], run.offset, run.bytes);
    if (!bytes)
    {
      return bytes.error();
    }
    for (std::size_t b = run.first; b < run.end; ++b)
    {
      const auto& [block, number] = runs.blocks[b];
      found[number] = *bytes + (block.offset - run.offset);
      if (!matchesChecksum(found[number], block.bytes, block.checksum))
      {
        return corruptStore(content.file->path(), block.offset,
          "node " + std::to_string(node) + ", block " + std::to_string(number) +
            ": the checksum does not match");
      }
    }
  }
  return StoredPayload{ std::move(*payload), std::move(found) };
}

} // namespace pointfront
