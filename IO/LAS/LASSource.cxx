#include "LASSource.h"

#include "LASPointDecoder.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::uint64_t pointsPerChunk = 65536;

/// Points may reach to the EVLRs behind them, or to the end of the file.
std::uint64_t endOfPoints(const LASFile& file)
{
  return file.header.extendedRecordCount > 0
    ? std::min<std::uint64_t>(file.header.extendedRecordOffset, file.map.size())
    : file.map.size();
}
} // namespace

Result<std::unique_ptr<PointSource>> LASSource::open(LASFile file)
{
  SourceDescription& description = file.description;
  const std::uint64_t claimed = file.header.pointCount;
  const std::uint64_t room = endOfPoints(file) - file.header.pointOffset;
  const std::uint64_t present = std::min(claimed, room / file.header.pointBytes);
  if (present < claimed)
  {
    const std::string where = "their bytes end at byte " + std::to_string(endOfPoints(file));
    if (present == 0)
    {
      return makeError(Error::Kind::Truncated,
        description.path + ": the header promises " + std::to_string(claimed) +
          " points from byte " + std::to_string(file.header.pointOffset) + " on, but " + where +
          ": there is none; get a whole copy");
    }
    description.warnings.push_back(std::to_string(claimed - present) + " of " +
      std::to_string(claimed) + " points are missing: " + where + ", after " +
      std::to_string(present) + " whole points.");
  }
  description.pointCount = present;
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
  const std::size_t count = static_cast<std::size_t>(chunkPoints(chunk));
  batch.resize(count, file_.layout.schema);
  const std::size_t offset =
    file_.header.pointOffset + chunk * pointsPerChunk * file_.layout.pointBytes;
  decodeLASPoints(file_.layout, file_.header.grid, file_.map.data() + offset, count, batch);
  // Read once, not kept: a file larger than the memory limit must not count against it.
  file_.map.release(offset, count * file_.layout.pointBytes);
  return {};
}

} // namespace pointfront
