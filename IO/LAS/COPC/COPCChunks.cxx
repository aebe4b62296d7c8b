#include "COPCChunks.h"

#include "LASBytes.h"
#include "LAZIntegerEncoder.h"

#include "pointfront/Threads/WorkBeside.h"

#include <algorithm>
#include <limits>
#include <memory>
#include <utility>

namespace pointfront
{
namespace
{
Result<LASzipWriter> beginChunk(const LASPointLayout& layout, const std::string& path)
{
  Result<LASzipWriter> laszip = LASzipWriter::create(layout, path, LASzipWriter::Chunks::Variable);
  if (!laszip)
  {
    return laszip;
  }
  if (auto done = laszip->beginChunk(); !done)
  {
    return done.error();
  }
  return laszip;
}

Result<std::vector<std::byte>> compressed(
  const LASPointLayout& layout, const std::string& path, const std::vector<std::byte>& raw)
{
  Result<LASzipWriter> laszip = beginChunk(layout, path);
  if (!laszip)
  {
    return laszip.error();
  }
  if (auto done = laszip->append(raw.data(), raw.size() / layout.pointBytes); !done)
  {
    return done.error();
  }
  return laszip->finishChunk();
}
} // namespace

COPCChunks::COPCChunks(const LASPointLayout& layout, const std::string& path, OutputFile& file,
  std::uint64_t offset, const COPCMemory& memory, std::string temporaryFolder)
  : layout_(layout)
  , path_(path)
  , file_(file)
  , end_(offset)
  , nodeBytes_(memory.nodeBytes)
  , threads_(memory.threads)
  , late_(std::move(temporaryFolder))
{
}

Result<void> COPCChunks::compressMeanwhile(Open& open, const std::byte* records, std::size_t count)
{
  if (!open.laszip)
  {
    Result<LASzipWriter> laszip = beginChunk(layout_, path_);
    if (!laszip)
    {
      return laszip.error();
    }
    open.laszip = std::move(*laszip);
  }
  return open.laszip->append(records, count);
}

Result<void> COPCChunks::add(int level, const glm::uvec3& cell, const std::byte* record)
{
  Open& open = open_[static_cast<std::size_t>(level)];
  open.exists = true;
  open.cell = cell;
  if (++open.points == std::numeric_limits<std::int32_t>::max())
  {
    return makeError(Error::Kind::BadArgument,
      path_ + ": more than 2147483646 points lie in one place, which COPC cannot count");
  }
  if (open.laszip)
  {
    return compressMeanwhile(open, record, 1);
  }
  const std::size_t size = open.raw.size() + layout_.pointBytes;
  if (size > open.raw.capacity())
  {
    open.raw.reserve(std::max(size, std::min(2 * size, nodeBytes_ + layout_.pointBytes)));
  }
  open.raw.insert(open.raw.end(), record, record + layout_.pointBytes);
  if (open.raw.size() < nodeBytes_)
  {
    return {};
  }
  const Result<void> done =
    compressMeanwhile(open, open.raw.data(), open.raw.size() / layout_.pointBytes);
  open.raw = std::vector<std::byte>(); // clear() would keep its memory
  return done;
}

Result<void> COPCChunks::close(int level)
{
  for (int l = static_cast<int>(levels) - 1; l >= level; --l)
  {
    Open& open = open_[static_cast<std::size_t>(l)];
    if (!open.exists)
    {
      continue;
    }
    if (l > 0)
    {
      Open& parent = open_[static_cast<std::size_t>(l) - 1];
      parent.exists = true;
      parent.inner = true;
      parent.cell = open.cell / 2u;
    }
    Pending pending;
    pending.inner = open.inner;
    pending.node.level = l;
    pending.node.cell = open.cell;
    pending.node.points = open.points;
    if (open.laszip)
    {
      std::promise<Chunk> chunk;
      chunk.set_value(open.laszip->finishChunk());
      pending.chunk = chunk.get_future();
    }
    else if (open.points > 0)
    {
      const auto raw = std::make_shared<std::vector<std::byte>>(std::move(open.raw));
      pending.chunk = workBeside([this, raw] { return compressed(layout_, path_, *raw); });
    }
    open = {};
    if (pending.node.points == 0)
    {
      nodes_.push_back(pending.node);
      continue;
    }
    pending_.push_back(std::move(pending));
    if (auto done = writeUntil(threads_); !done)
    {
      return done;
    }
  }
  return {};
}

Result<void> COPCChunks::writeUntil(std::size_t left)
{
  while (pending_.size() > left)
  {
    Pending first = std::move(pending_.front());
    pending_.pop_front();
    const Chunk chunk = first.chunk.get();
    if (!chunk)
    {
      return chunk.error();
    }
    if (chunk->size() > std::numeric_limits<std::int32_t>::max())
    {
      return makeError(Error::Kind::BadArgument,
        path_ + ": the points of one place take more bytes than COPC can count");
    }
    first.node.bytes = static_cast<std::uint32_t>(chunk->size());
    const std::size_t place = nodes_.size();
    nodes_.push_back(first.node);
    if (first.inner)
    {
      late_.begin(static_cast<std::uint32_t>(place));
    }
    if (auto done = first.inner ? late_.append(*chunk) : write(place, *chunk); !done)
    {
      return done;
    }
  }
  return {};
}

Result<void> COPCChunks::write(std::size_t node, const std::vector<std::byte>& chunk)
{
  nodes_[node].offset = end_;
  end_ += chunk.size();
  chunks_.push_back(node);
  return file_.append(chunk.data(), chunk.size());
}

Result<void> COPCChunks::settle()
{
  if (auto done = writeUntil(0); !done)
  {
    return done;
  }
  std::vector<std::uint32_t> inner;
  for (std::uint32_t place = 0; place < nodes_.size(); ++place)
  {
    if (late_.contains(place))
    {
      inner.push_back(place);
    }
  }
  // Cells of one level have come in an order of space.
  std::stable_sort(inner.begin(), inner.end(),
    [&](std::uint32_t a, std::uint32_t b) { return nodes_[a].level > nodes_[b].level; });
  for (const std::uint32_t place : inner)
  {
    const auto chunk = late_.read(place);
    if (auto done = chunk ? write(place, *chunk) : Result<void>(chunk.error()); !done)
    {
      return done;
    }
  }
  return {};
}

std::vector<std::byte> COPCChunks::table() const
{
  std::vector<std::byte> bytes(8); // version 0, number of chunks
  storeNumber(bytes.data() + 4, static_cast<std::uint32_t>(chunks_.size()));
  if (chunks_.empty())
  {
    return bytes;
  }
  LAZIntegerEncoder encoder;
  COPCNode before;
  for (const std::size_t place : chunks_)
  {
    const COPCNode& node = nodes_[place];
    encoder.add(before.points, node.points, 0);
    encoder.add(before.bytes, node.bytes, 1);
    before = node;
  }
  const std::vector<std::byte> code = encoder.finish();
  bytes.insert(bytes.end(), code.begin(), code.end());
  return bytes;
}

} // namespace pointfront
