#include "pointfront/Mosaic/InputSurvey.h"

#include "pointfront/Codec/Checksum.h"
#include "pointfront/Ingest/RecordColumns.h"
#include "pointfront/Ingest/RecordPacker.h"
#include "pointfront/Neighbourhood/CellHistogram.h"
#include "pointfront/Neighbourhood/PointReading.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <mutex>

namespace pointfront
{
namespace
{
Rejection reasonOf(const glm::dvec3& p)
{
  return std::isnan(p.x) || std::isnan(p.y) || std::isnan(p.z) ? Rejection::NotANumber
    : std::isinf(p.x) || std::isinf(p.y) || std::isinf(p.z)    ? Rejection::Infinite
                                                               : Rejection::OutsideGrid;
}

/// The survey of one thread's chunks, and what it works with.
class SurveyShare
{
public:
  SurveyShare(const PointSource& source, const TileGrid& grid)
    : source_(source)
    , grid_(grid)
    , colour_(wideColourColumn(source.description().schema))
  {
  }

  /// Points of the chunk.
  Result<std::uint64_t> add(std::uint64_t chunk, SurveyedChunk& surveyed)
  {
    if (Result<void> done = source_.read(chunk, batch_); !done)
    {
      return done.error();
    }
    if (batch_.size() > source_.chunkPoints(chunk))
    {
      return makeError(Error::Kind::BadFormat,
        "'" + source_.description().path + "' gave more points than it announced");
    }
    surveyed.hash = hashOfPoints(batch_);
    readClasses(source_.description().schema, batch_, classes_);
    for (std::size_t i = 0; i < batch_.size(); ++i)
    {
      const glm::dvec3& p = batch_.positions[i];
      if (!hasPlace(p))
      {
        ++survey.rejected[nameOf(reasonOf(p))];
        continue;
      }
      surveyed.bounds.add(p);
      survey.classes.set(classes_[i]);
      countIn(grid_.of(p));
    }
    addColours();
    survey.read += batch_.size();
    return std::uint64_t(batch_.size());
  }

  InputSurvey survey; ///< without chunks

private:
  void countIn(const TileIndex& tile)
  {
    if (last_ == nullptr || !(lastTile_ == tile)) // points come in runs
    {
      lastTile_ = tile;
      last_ = &survey.tiles[tile]; // stays where it is
    }
    ++*last_;
  }

  void addColours()
  {
    if (!colour_)
    {
      return;
    }
    const std::vector<std::byte>& column = batch_.columns[*colour_];
    for (std::size_t at = 0; at + 1 < column.size(); at += sizeof(std::uint16_t))
    {
      std::uint16_t value = 0;
      std::memcpy(&value, column.data() + at, sizeof value);
      survey.largestColour = std::max(survey.largestColour, value);
    }
  }

  const PointSource& source_;
  const TileGrid& grid_;
  std::optional<std::size_t> colour_;
  PointBatch batch_;
  std::vector<std::uint8_t> classes_;
  std::uint64_t* last_ = nullptr;
  TileIndex lastTile_;
};

void merge(const InputSurvey& share, InputSurvey& survey)
{
  for (const auto& [tile, points] : share.tiles)
  {
    survey.tiles[tile] += points;
  }
  for (const auto& [reason, points] : share.rejected)
  {
    survey.rejected[reason] += points;
  }
  survey.read += share.read;
  survey.classes |= share.classes;
  survey.largestColour = std::max(survey.largestColour, share.largestColour);
}
} // namespace

std::uint64_t hashOfPoints(const PointBatch& batch)
{
  std::uint64_t hash = contentHash(reinterpret_cast<const std::byte*>(batch.positions.data()),
    batch.positions.size() * sizeof(glm::dvec3));
  for (const std::vector<std::byte>& column : batch.columns)
  {
    hash = contentHash(column.data(), column.size(), hash);
  }
  return hash;
}

Bounds InputSurvey::bounds() const
{
  Bounds all;
  for (const SurveyedChunk& chunk : chunks)
  {
    all.add(chunk.bounds);
  }
  return all;
}

Result<InputSurvey> surveyInput(const PointSource& source, const TileGrid& grid, WorkCrew& crew)
{
  InputSurvey survey;
  survey.chunks.resize(source.chunkCount());
  std::atomic<std::uint64_t> next{ 0 };
  std::mutex mutex;
  const auto work = [&]() -> Result<void>
  {
    SurveyShare share(source, grid);
    for (std::uint64_t chunk = next++; chunk < survey.chunks.size() && !crew.stopped();
         chunk = next++)
    {
      const Result<std::uint64_t> read = share.add(chunk, survey.chunks[chunk]);
      if (!read)
      {
        return read.error();
      }
      crew.advance(*read);
    }
    const std::lock_guard<std::mutex> lock(mutex);
    merge(share.survey, survey);
    return {};
  };
  if (Result<void> done = crew.run(work); !done)
  {
    return done.error();
  }
  return survey;
}

} // namespace pointfront
