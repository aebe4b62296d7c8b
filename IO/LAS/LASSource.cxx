#include "LASSource.h"

#include "LASPointDecoder.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::uint64_t pointsPerChunk = 16384;
} // namespace

Result<std::unique_ptr<PointSource>> LASSource::open(LASFile file)
{
  if (Result<void> counted = file.countRecords(); !counted)
  {
    return counted.error();
  }
  return std::unique_ptr<PointSource>(new LASSource(std::move(file)));
}

std::uint64_t LASSource::chunkCount() const
{
  return (description().pointCount + pointsPerChunk - 1) / pointsPerChunk;
}

std::uint64_t LASSource::chunkPoints(std::uint64_t chunk) const
{
  assert(chunk < chunkCount());
  return std::min(pointsPerChunk, description().pointCount - chunk * pointsPerChunk);
}

Result<void> LASSource::read(std::uint64_t chunk, PointBatch& batch) const
{
  batch.resize(static_cast<std::size_t>(chunkPoints(chunk)), file_.layout.schema);
  decode(chunk, batch);
  return file_.map.checkWhole();
}

Result<void> LASSource::readSteps(std::uint64_t chunk, PointBatch& batch) const
{
  batch.resizeSteps(static_cast<std::size_t>(chunkPoints(chunk)), file_.layout.schema);
  decode(chunk, batch);
  return file_.map.checkWhole();
}

void LASSource::decode(std::uint64_t chunk, PointBatch& batch) const
{
  const std::size_t offset =
    file_.header.pointOffset + chunk * pointsPerChunk * file_.layout.pointBytes;
  decodeLASPoints(file_.layout, file_.header.grid, file_.map.data() + offset, batch.size(), batch);
  // Read once, not kept: a file larger than the memory limit must not count against it.
  file_.map.release(offset, batch.size() * file_.layout.pointBytes);
}

} // namespace pointfront
