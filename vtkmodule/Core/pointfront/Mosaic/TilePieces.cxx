#include "pointfront/Mosaic/TilePieces.h"

#include "pointfront/Base/RawBytes.h"
#include "pointfront/Disk/SpillFile.h"
#include "pointfront/Neighbourhood/CellHistogram.h"

#include <algorithm>
#include <atomic>
#include <cstring>
#include <filesystem>

namespace pointfront
{
namespace
{
/// Less memory than this is left to the build, which may need all of it.
constexpr std::uint64_t leastToHold = std::uint64_t(512) << 20;

/// The part of a chunk that lies in the box: positions, then column after column.
struct Piece
{
  RawBytes held; ///< empty: the bytes are in the file
  std::uint64_t offset = 0;
  std::uint64_t points = 0;
  std::uint64_t own = 0;
};

std::size_t bytesOfPoint(const AttributeSchema& schema)
{
  return sizeof(glm::dvec3) + schema.pointBytes();
}

/// The points of a batch that are kept, as runs: points that lie together come together.
class KeptRuns
{
public:
  /// A point, in rising order.
  void add(std::size_t point)
  {
    if (runs_.empty() || runs_.back().begin + runs_.back().points != point)
    {
      runs_.push_back({ point, 0 });
    }
    ++runs_.back().points;
    ++points_;
  }
  std::size_t points() const { return points_; }

  void leaveOnly(PointBatch& batch, const AttributeSchema& schema) const
  {
    if (points_ == batch.size())
    {
      return;
    }
    leave(reinterpret_cast<std::byte*>(batch.positions.data()), sizeof(glm::dvec3));
    batch.positions.resize(points_);
    for (std::size_t c = 0; c < schema.size(); ++c)
    {
      leave(batch.columns[c].data(), schema[c].bytes());
      batch.columns[c].resize(points_ * schema[c].bytes());
    }
  }

private:
  struct Run
  {
    std::size_t begin = 0;
    std::size_t points = 0;
  };
  void leave(std::byte* values, std::size_t bytes) const
  {
    std::byte* to = values;
    for (const Run& run : runs_)
    {
      std::memmove(to, values + run.begin * bytes, run.points * bytes);
      to += run.points * bytes;
    }
  }

  std::vector<Run> runs_;
  std::size_t points_ = 0;
};

/// The description of an input of which only some chunks are left, under new numbers.
SourceDescription descriptionOf(const PointSource& source, const std::vector<std::uint64_t>& chunks,
  std::uint64_t points, bool deepColours)
{
  SourceDescription description = source.description();
  description.pointCount = points;
  description.headerPointCount.reset(); // the input as a whole was asked what is missing
  description.warnings.clear(); // they were told
  description.deepColours = description.deepColours || deepColours;
  for (ScannerPlace& place : description.scanners)
  {
    place.firstChunk = static_cast<std::uint64_t>(
      std::lower_bound(chunks.begin(), chunks.end(), place.firstChunk) - chunks.begin());
  }
  return description;
}

class PieceSource final : public PointSource
{
public:
  PieceSource(
    SourceDescription description, std::vector<Piece> pieces, std::shared_ptr<SpillFile> file)
    : description_(std::move(description))
    , pieces_(std::move(pieces))
    , file_(std::move(file))
  {
  }
  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return pieces_.size(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override { return pieces_[chunk].points; }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    const Piece& piece = pieces_[chunk];
    const AttributeSchema& schema = description_.schema;
    batch.resize(piece.points, schema);
    thread_local std::vector<std::byte> bytes; // kept: new memory is cleared first
    const std::byte* from = piece.held.data.get();
    if (piece.held.size == 0)
    {
      bytes.resize(std::max(bytes.size(), piece.points * bytesOfPoint(schema)));
      if (Result<void> done =
            file_->read(piece.offset, bytes.data(), piece.points * bytesOfPoint(schema));
          !done)
      {
        return done;
      }
      from = bytes.data();
    }
    const auto take = [&from](void* to, std::size_t size)
    {
      if (size > 0)
      {
        std::memcpy(to, from, size);
        from += size;
      }
    };
    take(batch.positions.data(), piece.points * sizeof(glm::dvec3));
    for (std::vector<std::byte>& column : batch.columns)
    {
      take(column.data(), column.size());
    }
    return {};
  }

private:
  SourceDescription description_;
  std::vector<Piece> pieces_;
  std::shared_ptr<SpillFile> file_;
};

class OwnSource final : public PointSource
{
public:
  OwnSource(std::unique_ptr<PointSource> source, std::vector<std::uint64_t> own,
    const TileGrid& grid, const TileIndex& tile)
    : source_(std::move(source))
    , own_(std::move(own))
    , grid_(grid)
    , tile_(tile)
    , description_(source_->description())
  {
    description_.pointCount = 0;
    for (const std::uint64_t points : own_)
    {
      description_.pointCount += points;
    }
  }
  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return own_.size(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override { return own_[chunk]; }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    if (own_[chunk] == 0)
    {
      batch.resize(0, description_.schema);
      return {};
    }
    if (Result<void> done = source_->read(chunk, batch); !done)
    {
      return done;
    }
    if (batch.size() == own_[chunk])
    {
      return {};
    }
    KeptRuns kept;
    for (std::size_t i = 0; i < batch.size(); ++i)
    {
      if (grid_.of(batch.positions[i]) == tile_)
      {
        kept.add(i);
      }
    }
    kept.leaveOnly(batch, description_.schema);
    return {};
  }

private:
  std::unique_ptr<PointSource> source_;
  std::vector<std::uint64_t> own_;
  TileGrid grid_;
  TileIndex tile_;
  SourceDescription description_;
};

/// All chunks of all inputs, cut by several threads.
class Cutting
{
public:
  Cutting(const TileInputs& inputs, const TileGrid& grid, const TileIndex& tile,
    const Bounds& known, SpillFile& file, std::uint64_t holdAtMost)
    : inputs_(inputs)
    , grid_(grid)
    , tile_(tile)
    , known_(known)
    , file_(file)
    , holdAtMost_(holdAtMost)
  {
    for (std::size_t s = 0; s < inputs.sources.size(); ++s)
    {
      pieces_.emplace_back(inputs.chunks[s].size());
      for (std::size_t n = 0; n < inputs.chunks[s].size(); ++n)
      {
        places_.push_back({ s, n });
      }
    }
  }

  Result<void> work(WorkCrew& crew)
  {
    PointBatch batch;
    for (std::size_t next = next_++; next < places_.size() && !crew.stopped(); next = next_++)
    {
      const auto [source, number] = places_[next];
      const std::uint64_t chunk = inputs_.chunks[source][number];
      if (Result<void> done = cut(source, number, batch); !done)
      {
        return done;
      }
      crew.advance(inputs_.sources[source]->chunkPoints(chunk));
    }
    return {};
  }

  std::vector<Piece>& pieces(std::size_t source) { return pieces_[source]; }
  std::uint64_t heldBytes() const { return held_; }

private:
  Result<void> cut(std::size_t input, std::size_t number, PointBatch& batch)
  {
    const PointSource& source = *inputs_.sources[input];
    Piece& piece = pieces_[input][number];
    if (Result<void> done = source.read(inputs_.chunks[input][number], batch); !done)
    {
      return done;
    }
    if (hashOfPoints(batch) != inputs_.hashes[input][number])
    {
      return makeError(Error::Kind::Corrupt,
        source.description().path +
          ": has changed since it was surveyed; run the same command again");
    }
    KeptRuns kept;
    for (std::size_t i = 0; i < batch.size(); ++i)
    {
      const glm::dvec3& p = batch.positions[i];
      if (!hasPlace(p))
      {
        continue;
      }
      const bool own = grid_.of(p) == tile_;
      if (own || known_.contains(p))
      {
        kept.add(i);
        piece.own += own ? 1 : 0;
      }
    }
    const AttributeSchema& schema = source.description().schema;
    kept.leaveOnly(batch, schema);
    piece.points = kept.points();
    return piece.points == 0 ? Result<void>() : keep(piece, batch, schema);
  }

  /// In memory as long as there is some left, then in the file.
  Result<void> keep(Piece& piece, const PointBatch& batch, const AttributeSchema& schema)
  {
    const std::size_t size = piece.points * bytesOfPoint(schema);
    thread_local std::vector<std::byte> bytes; // on their way to the file
    const bool held = held_.fetch_add(size) + size <= holdAtMost_;
    if (held)
    {
      piece.held = RawBytes(size);
    }
    else
    {
      held_ -= size;
      bytes.resize(size);
    }
    std::byte* const begin = held ? piece.held.data.get() : bytes.data();
    std::byte* to = begin;
    const auto put = [&to](const void* from, std::size_t count)
    {
      if (count > 0)
      {
        std::memcpy(to, from, count);
        to += count;
      }
    };
    put(batch.positions.data(), piece.points * sizeof(glm::dvec3));
    for (const std::vector<std::byte>& column : batch.columns)
    {
      put(column.data(), column.size());
    }
    if (held)
    {
      return {};
    }
    piece.offset = end_.fetch_add(size);
    return file_.write(piece.offset, begin, size);
  }

  const TileInputs& inputs_;
  const TileGrid& grid_;
  const TileIndex& tile_;
  const Bounds& known_;
  SpillFile& file_;
  std::uint64_t holdAtMost_;
  std::vector<std::pair<std::size_t, std::size_t>> places_; // source, number in its list
  std::vector<std::vector<Piece>> pieces_;
  std::atomic<std::size_t> next_{ 0 };
  std::atomic<std::uint64_t> end_{ 0 };
  std::atomic<std::uint64_t> held_{ 0 };
};
} // namespace

Result<TilePieces> TilePieces::of(const TileInputs& inputs, const TileGrid& grid,
  const TileIndex& tile, const Bounds& known, const PassResources& resources, WorkCrew& crew)
{
  const std::string folder = resources.temporaryFolder.empty()
    ? std::filesystem::temp_directory_path().string()
    : resources.temporaryFolder;
  Result<std::unique_ptr<SpillFile>> created = SpillFile::create(folder, 0);
  if (!created)
  {
    return created.error();
  }
  const std::shared_ptr<SpillFile> file = std::move(*created);
  const std::uint64_t holdAtMost =
    resources.memoryBytes >= leastToHold ? resources.memoryBytes / 4 : 0;
  Cutting cutting(inputs, grid, tile, known, *file, holdAtMost);
  if (Result<void> done = crew.run([&] { return cutting.work(crew); }); !done)
  {
    return done.error();
  }
  TilePieces result;
  result.heldBytes = cutting.heldBytes();
  for (std::size_t s = 0; s < inputs.sources.size(); ++s)
  {
    std::uint64_t points = 0;
    std::vector<std::uint64_t> own;
    for (const Piece& piece : cutting.pieces(s))
    {
      points += piece.points;
      own.push_back(piece.own);
    }
    SourceDescription description =
      descriptionOf(*inputs.sources[s], inputs.chunks[s], points, inputs.deepColours[s]);
    result.sources.push_back(
      std::make_unique<PieceSource>(std::move(description), std::move(cutting.pieces(s)), file));
    result.own.push_back(std::move(own));
  }
  return result;
}

PointSources ownPoints(PointSources sources, std::vector<std::vector<std::uint64_t>> own,
  const TileGrid& grid, const TileIndex& tile)
{
  PointSources result;
  for (std::size_t s = 0; s < sources.size(); ++s)
  {
    result.push_back(
      std::make_unique<OwnSource>(std::move(sources[s]), std::move(own[s]), grid, tile));
  }
  return result;
}

} // namespace pointfront
