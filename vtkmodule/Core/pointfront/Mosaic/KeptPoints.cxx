#include "pointfront/Mosaic/KeptPoints.h"

#include "pointfront/Codec/BlockCodec.h"
#include "pointfront/Codec/Checksum.h"
#include "pointfront/Disk/InputFile.h"
#include "pointfront/Disk/TemporaryFile.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <unistd.h>

// The file: blocks in the order they were written; a row of three numbers for each chunk (Block);
// a trailer of four: hash of key and shape, chunks, hash of the rows, offset of the rows.
// A block: points (32 bits), how positions are given (Positions), and the coded positions and
// columns, each after its codec (8 bits) and its size (32 bits). A store codes its blocks likewise:
// most inputs whose points are kept are too many for memory, so that fewer bytes are sooner written
// and read.

namespace pointfront
{
namespace
{
enum class Positions : std::uint8_t
{
  World = 0,
  Steps = 1
};
constexpr std::size_t rowNumbers = 3;
constexpr std::size_t trailerNumbers = 4;

/// The points as steps of the grid; false if that is not exact for one of them.
bool stepsOf(const std::vector<glm::dvec3>& positions, const QuantisationGrid& grid,
  std::vector<glm::ivec3>& steps)
{
  constexpr double most = 2147483647.0;
  steps.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i)
  {
    const glm::dvec3 at = (positions[i] - grid.offset) / grid.scale;
    if (!(std::abs(at.x) < most && std::abs(at.y) < most && std::abs(at.z) < most))
    {
      return false;
    }
    steps[i] = { static_cast<int>(std::lrint(at.x)), static_cast<int>(std::lrint(at.y)),
      static_cast<int>(std::lrint(at.z)) };
    const glm::dvec3 back = grid.toWorld(GridPosition(steps[i]));
    // Zero has two signs.
    if (std::memcmp(&back, &positions[i], sizeof back) != 0)
    {
      return false;
    }
  }
  return true;
}

void append(std::vector<std::byte>& block, const void* data, std::size_t bytes)
{
  const auto* const from = static_cast<const std::byte*>(data);
  block.insert(block.end(), from, from + bytes);
}

void encodeValues(const void* values, const BlockShape& shape, std::vector<std::byte>& block)
{
  const CodedBlock coded = encodeBlock(static_cast<const std::byte*>(values), shape);
  const auto bytes = static_cast<std::uint32_t>(coded.bytes.size());
  block.push_back(static_cast<std::byte>(coded.codec));
  append(block, &bytes, sizeof bytes);
  append(block, coded.bytes.data(), coded.bytes.size());
}

BlockShape shapeOf(std::size_t points, const Attribute& attribute)
{
  return { points, attribute.components,
    static_cast<unsigned>(attribute.bytes() / attribute.components) };
}

void encode(const PointBatch& batch, const AttributeSchema& schema,
  const std::optional<QuantisationGrid>& grid, std::vector<std::byte>& block)
{
  thread_local std::vector<glm::ivec3> steps;
  const auto points = static_cast<std::uint32_t>(batch.positions.size());
  block.clear();
  append(block, &points, sizeof points);
  const bool whole = grid && stepsOf(batch.positions, *grid, steps);
  block.push_back(std::byte(whole ? Positions::Steps : Positions::World));
  whole ? encodeValues(steps.data(), { points, 3, sizeof(int) }, block)
        : encodeValues(batch.positions.data(), { points, 3, sizeof(double) }, block);
  for (std::size_t c = 0; c < schema.size(); ++c)
  {
    encodeValues(batch.columns[c].data(), shapeOf(points, schema[c]), block);
  }
}

/// Takes bytes of a block one after the other.
class BlockReader
{
public:
  BlockReader(const std::byte* bytes, std::size_t size)
    : next_(bytes)
    , left_(size)
  {
  }
  bool take(void* to, std::size_t bytes)
  {
    if (bytes > left_)
    {
      return false;
    }
    std::memcpy(to, next_, bytes);
    next_ += bytes;
    left_ -= bytes;
    return true;
  }
  bool takeValues(const BlockShape& shape, void* values)
  {
    std::uint8_t codec = 0;
    std::uint32_t bytes = 0;
    if (!take(&codec, sizeof codec) || !take(&bytes, sizeof bytes) || bytes > left_ ||
      !decodeBlock(
        static_cast<BlockCodec>(codec), next_, bytes, shape, static_cast<std::byte*>(values)))
    {
      return false;
    }
    next_ += bytes;
    left_ -= bytes;
    return true;
  }
  bool atEnd() const { return left_ == 0; }

private:
  const std::byte* next_;
  std::size_t left_;
};

bool decode(const std::byte* bytes, std::size_t size, std::uint64_t mostPoints,
  const AttributeSchema& schema, const std::optional<QuantisationGrid>& grid, PointBatch& batch)
{
  BlockReader block(bytes, size);
  std::uint32_t points = 0;
  std::uint8_t kind = 0;
  if (!block.take(&points, sizeof points) || !block.take(&kind, sizeof kind) || points > mostPoints)
  {
    return false;
  }
  batch.resize(points, schema);
  if (kind == static_cast<std::uint8_t>(Positions::World))
  {
    if (!block.takeValues({ points, 3, sizeof(double) }, batch.positions.data()))
    {
      return false;
    }
  }
  else
  {
    thread_local std::vector<glm::ivec3> steps;
    steps.resize(points);
    if (!grid || !block.takeValues({ points, 3, sizeof(int) }, steps.data()))
    {
      return false;
    }
    for (std::size_t i = 0; i < points; ++i)
    {
      batch.positions[i] = grid->toWorld(GridPosition(steps[i]));
    }
  }
  for (std::size_t c = 0; c < schema.size(); ++c)
  {
    if (!block.takeValues(shapeOf(points, schema[c]), batch.columns[c].data()))
    {
      return false;
    }
  }
  return block.atEnd();
}

/// Tells files of other inputs, of inputs that are read otherwise, and of older versions.
std::uint64_t hashOfShape(const std::string& key, const AttributeSchema& schema,
  const std::optional<QuantisationGrid>& grid)
{
  std::string text = "coded " + key;
  for (const Attribute& attribute : schema)
  {
    text += " " + attribute.name + " " + std::to_string(static_cast<int>(attribute.type)) + " " +
      std::to_string(attribute.components);
  }
  const std::uint64_t hash =
    contentHash(reinterpret_cast<const std::byte*>(text.data()), text.size());
  return grid ? contentHash(reinterpret_cast<const std::byte*>(&*grid), sizeof *grid, hash) : hash;
}

std::uint64_t hashOfNumbers(const std::vector<std::uint64_t>& numbers)
{
  return contentHash(
    reinterpret_cast<const std::byte*>(numbers.data()), numbers.size() * sizeof(std::uint64_t));
}

/// The source with a keeper.
class KeepingSource final : public PointSource
{
public:
  KeepingSource(std::unique_ptr<PointSource> source, std::shared_ptr<PointKeeper> keeper)
    : source_(std::move(source))
    , keeper_(std::move(keeper))
  {
  }
  const SourceDescription& description() const override { return source_->description(); }
  std::uint64_t chunkCount() const override { return source_->chunkCount(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override
  {
    return source_->chunkPoints(chunk);
  }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    Result<void> done = source_->read(chunk, batch);
    if (done)
    {
      keeper_->add(chunk, batch);
    }
    return done;
  }

private:
  std::unique_ptr<PointSource> source_;
  std::shared_ptr<PointKeeper> keeper_;
};
} // namespace

Result<std::shared_ptr<PointKeeper>> PointKeeper::create(
  const std::string& path, const PointSource& source)
{
  Result<TemporaryFile> file = createTemporaryFile(path);
  if (!file)
  {
    return file.error();
  }
  std::shared_ptr<PointKeeper> keeper(
    new PointKeeper(path, source.description(), source.chunkCount()));
  keeper->meanwhile_ = file->path;
  keeper->descriptor_ = file->descriptor;
  return keeper;
}

PointKeeper::PointKeeper(
  std::string path, const SourceDescription& description, std::uint64_t chunks)
  : path_(std::move(path))
  , schema_(description.schema)
  , grid_(description.grid)
  , blocks_(chunks)
{
}

PointKeeper::~PointKeeper()
{
  if (!meanwhile_.empty())
  {
    std::remove(meanwhile_.c_str());
  }
  if (descriptor_ >= 0)
  {
    close(descriptor_);
  }
}

void PointKeeper::write(std::uint64_t offset, const std::byte* data, std::size_t bytes)
{
  while (bytes > 0 && fault_ == 0)
  {
    const ssize_t done = pwrite(descriptor_, data, bytes, static_cast<off_t>(offset));
    if (done < 0 && errno == EINTR)
    {
      continue;
    }
    if (done <= 0)
    {
      fault_ = done < 0 ? errno : ENOSPC;
      return;
    }
    data += done;
    offset += static_cast<std::uint64_t>(done);
    bytes -= static_cast<std::size_t>(done);
  }
}

void PointKeeper::add(std::uint64_t chunk, const PointBatch& batch)
{
  if (fault_ != 0 || blocks_[chunk].bytes > 0) // passes may read a chunk before the survey does
  {
    return;
  }
  thread_local std::vector<std::byte> block;
  encode(batch, schema_, grid_, block);
  const std::uint64_t offset = end_.fetch_add(block.size());
  write(offset, block.data(), block.size());
  blocks_[chunk] = { offset, block.size(), contentHash(block.data(), block.size()) };
}

Result<std::uint64_t> PointKeeper::finish(const std::string& key)
{
  std::vector<std::uint64_t> numbers;
  for (const Block& block : blocks_)
  {
    numbers.insert(numbers.end(), { block.offset, block.bytes, block.hash });
  }
  const std::uint64_t hash = hashOfNumbers(numbers);
  numbers.insert(
    numbers.end(), { hashOfShape(key, schema_, grid_), blocks_.size(), hash, end_.load() });
  const std::size_t bytes = numbers.size() * sizeof(std::uint64_t);
  write(end_, reinterpret_cast<const std::byte*>(numbers.data()), bytes);
  if (fault_ != 0)
  {
    return makeError(
      Error::Kind::Unwritable, "cannot write '" + path_ + "': " + std::strerror(fault_));
  }
  if (Result<void> named = nameTemporaryFile(meanwhile_, path_, true); !named)
  {
    return named.error();
  }
  meanwhile_.clear();
  return end_ + bytes;
}

/// The source, or what was kept of it.
class KeptPoints final : public PointSource
{
public:
  /// Null, and the source stays, if the file is not of that source.
  static std::unique_ptr<PointSource> of(
    std::unique_ptr<PointSource>& source, const std::string& path, const std::string& key)
  {
    Result<std::unique_ptr<const InputFile>> file = InputFile::open(path);
    std::vector<PointKeeper::Block> blocks;
    if (!file || !readRows(**file, *source, key, blocks))
    {
      return nullptr;
    }
    return std::unique_ptr<PointSource>(
      new KeptPoints(std::move(source), std::move(*file), std::move(blocks)));
  }

  const SourceDescription& description() const override { return source_->description(); }
  std::uint64_t chunkCount() const override { return source_->chunkCount(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override
  {
    return source_->chunkPoints(chunk);
  }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    return readKept(chunk, batch) ? Result<void>() : source_->read(chunk, batch);
  }

private:
  KeptPoints(std::unique_ptr<PointSource> source, std::unique_ptr<const InputFile> file,
    std::vector<PointKeeper::Block> blocks)
    : source_(std::move(source))
    , file_(std::move(file))
    , blocks_(std::move(blocks))
  {
  }

  static bool readRows(const InputFile& file, const PointSource& source, const std::string& key,
    std::vector<PointKeeper::Block>& blocks)
  {
    std::vector<std::uint64_t> trailer(trailerNumbers);
    const std::uint64_t trailerBytes = trailerNumbers * sizeof(std::uint64_t);
    const std::uint64_t chunks = source.chunkCount();
    const std::uint64_t rowBytes = chunks * rowNumbers * sizeof(std::uint64_t);
    if (file.bytes() < trailerBytes + rowBytes ||
      !take(file, file.bytes() - trailerBytes, trailer.data(), trailerBytes))
    {
      return false;
    }
    const SourceDescription& description = source.description();
    const std::uint64_t rowsAt = file.bytes() - trailerBytes - rowBytes;
    if (trailer[0] != hashOfShape(key, description.schema, description.grid) ||
      trailer[1] != chunks || trailer[3] != rowsAt)
    {
      return false;
    }
    std::vector<std::uint64_t> rows(chunks * rowNumbers);
    if (!take(file, rowsAt, rows.data(), rowBytes) || hashOfNumbers(rows) != trailer[2])
    {
      return false;
    }
    for (std::size_t at = 0; at < rows.size(); at += rowNumbers)
    {
      blocks.push_back({ rows[at], rows[at + 1], rows[at + 2] });
    }
    return true;
  }

  static bool take(const InputFile& file, std::uint64_t offset, void* to, std::size_t bytes)
  {
    return bytes == 0 || file.readAt(offset, static_cast<std::byte*>(to), bytes).ok();
  }

  bool readKept(std::uint64_t chunk, PointBatch& batch) const
  {
    const PointKeeper::Block& block = blocks_[chunk];
    thread_local std::vector<std::byte> bytes;
    bytes.resize(std::max(bytes.size(), block.bytes));
    const SourceDescription& description = source_->description();
    return block.bytes > 0 && take(*file_, block.offset, bytes.data(), block.bytes) &&
      contentHash(bytes.data(), block.bytes) == block.hash &&
      decode(bytes.data(), block.bytes, source_->chunkPoints(chunk), description.schema,
        description.grid, batch);
  }

  std::unique_ptr<PointSource> source_;
  std::unique_ptr<const InputFile> file_;
  std::vector<PointKeeper::Block> blocks_;
};

std::unique_ptr<PointSource> keeping(
  std::unique_ptr<PointSource> source, std::shared_ptr<PointKeeper> keeper)
{
  return std::make_unique<KeepingSource>(std::move(source), std::move(keeper));
}

std::unique_ptr<PointSource> fromKept(
  std::unique_ptr<PointSource> source, const std::string& path, const std::string& key)
{
  std::unique_ptr<PointSource> kept = KeptPoints::of(source, path, key);
  return kept ? std::move(kept) : std::move(source);
}

} // namespace pointfront
