#include "PLYBinaryTable.h"

#include "pointfront/Table/RecordNumbers.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::uint64_t rowsPerChunk = 32768;

/// Rows of different lengths, one after the other.
class RowWalk
{
public:
  RowWalk(const MemoryMap& map, const PLYElement& element, bool swapped, std::size_t offset)
    : map_(map)
    , element_(element)
    , swapped_(swapped)
    , offset_(offset)
  {
  }

  std::size_t offset() const { return offset_; }
  /// To the next row; gives the bytes at which the scalars of the passed one begin. False, and no
  /// step, if the file ends inside it.
  bool step(std::vector<std::size_t>* scalars)
  {
    std::size_t at = offset_;
    std::size_t scalar = 0;
    for (const PLYProperty& property : element_.properties)
    {
      if (!property.listCount)
      {
        if (scalars != nullptr)
        {
          (*scalars)[scalar++] = at;
        }
        if (!pass(at, sizeOf(property.type), 1.0))
        {
          return false;
        }
        continue;
      }
      const std::size_t countAt = at;
      if (!pass(at, sizeOf(*property.listCount), 1.0))
      {
        return false;
      }
      double count = 0.0;
      gatherNumbers({ map_.data() + countAt, 0, *property.listCount, swapped_ }, 1, &count);
      if (!pass(at, sizeOf(property.type), count))
      {
        return false;
      }
    }
    offset_ = at;
    return true;
  }

private:
  bool pass(std::size_t& at, std::size_t bytes, double count) const
  {
    const std::size_t room = (map_.size() - at) / bytes;
    if (!(count >= 0.0 && count <= static_cast<double>(room)))
    {
      return false;
    }
    at += bytes * static_cast<std::size_t>(count);
    return true;
  }

  const MemoryMap& map_;
  const PLYElement& element_;
  bool swapped_;
  std::size_t offset_;
};

/// Where an element's rows end; nothing if the file ends before.
std::optional<std::size_t> endOf(
  const MemoryMap& map, const PLYElement& element, bool swapped, std::size_t begin)
{
  if (element.hasList())
  {
    RowWalk walk(map, element, swapped, begin);
    for (std::uint64_t row = 0; row < element.count; ++row)
    {
      if (!walk.step(nullptr))
      {
        return std::nullopt;
      }
    }
    return walk.offset();
  }
  const std::size_t bytes = element.rowBytes();
  if (bytes > 0 && element.count > (map.size() - begin) / bytes)
  {
    return std::nullopt;
  }
  return begin + static_cast<std::size_t>(element.count) * bytes;
}
} // namespace

PLYBinaryTable::PLYBinaryTable(PLYFile file)
  : file_(std::move(file))
  , fields_(file_.fields())
  , swapped_((file_.header.encoding == PLYEncoding::LittleEndian) != machineIsLittleEndian())
{
}

Result<void> PLYBinaryTable::locate()
{
  const PLYElement& points = file_.pointElement();
  std::size_t begin = file_.header.bodyOffset;
  for (std::size_t e = 0; e < file_.points; ++e)
  {
    const PLYElement& element = file_.header.elements[e];
    const auto end = endOf(file_.map, element, swapped_, begin);
    if (!end)
    {
      return makeError(Error::Kind::Truncated,
        file_.path + ": the file ends inside the " + std::to_string(element.count) + " '" +
          element.name + "' that stand before the points; get a whole copy");
    }
    begin = *end;
  }
  begin_ = begin;
  if (!points.hasList())
  {
    const std::size_t bytes = points.rowBytes();
    const std::uint64_t room = bytes == 0 ? 0 : (file_.map.size() - begin) / bytes;
    rows_ = std::min(points.count, room);
    return {};
  }
  RowWalk walk(file_.map, points, swapped_, begin);
  for (rows_ = 0; rows_ < points.count; ++rows_)
  {
    const std::size_t row = walk.offset();
    if (!walk.step(nullptr))
    {
      break;
    }
    if (rows_ % rowsPerChunk == 0)
    {
      chunkBegins_.push_back(row);
    }
  }
  return {};
}

Result<std::unique_ptr<PointTable>> PLYBinaryTable::open(PLYFile file)
{
  auto table = std::unique_ptr<PLYBinaryTable>(new PLYBinaryTable(std::move(file)));
  if (Result<void> found = table->file_.map.checkWhole(table->locate()); !found)
  {
    return found.error();
  }
  const std::uint64_t claimed = table->file_.pointElement().count;
  const std::uint64_t present = table->rows_;
  const std::string where = "the file ends at byte " + std::to_string(table->file_.map.size());
  if (present == 0 && claimed > 0)
  {
    return makeError(Error::Kind::Truncated,
      table->file_.path + ": the header promises " + std::to_string(claimed) +
        " points from byte " + std::to_string(table->begin_) + " on, but " + where +
        ": there is none; get a whole copy");
  }
  if (present < claimed)
  {
    table->file_.warnings.push_back(std::to_string(claimed - present) + " of " +
      std::to_string(claimed) + " points are missing: " + where + ", after " +
      std::to_string(present) + " whole points.");
  }
  return std::unique_ptr<PointTable>(std::move(table));
}

std::uint64_t PLYBinaryTable::chunkCount() const
{
  return (rows_ + rowsPerChunk - 1) / rowsPerChunk;
}

std::uint64_t PLYBinaryTable::chunkRows(std::uint64_t chunk) const
{
  assert(chunk < chunkCount());
  return std::min(rowsPerChunk, rows_ - chunk * rowsPerChunk);
}

void PLYBinaryTable::readFixed(
  std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const
{
  const std::size_t stride = file_.pointElement().rowBytes();
  const auto rows = static_cast<std::size_t>(chunkRows(chunk));
  const std::size_t begin = begin_ + static_cast<std::size_t>(chunk * rowsPerChunk) * stride;
  std::size_t offset = begin;
  for (std::size_t f = 0; f < fields_.size(); ++f)
  {
    if (wanted[f])
    {
      gatherNumbers({ file_.map.data() + offset, stride, *fields_[f].type, swapped_ }, rows,
        block.columns[f].data());
    }
    offset += sizeOf(*fields_[f].type);
  }
  file_.map.release(begin, rows * stride);
}

void PLYBinaryTable::readListed(
  std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const
{
  const std::size_t begin = chunkBegins_[static_cast<std::size_t>(chunk)];
  RowWalk walk(file_.map, file_.pointElement(), swapped_, begin);
  std::vector<std::size_t> scalars(fields_.size());
  const auto rows = static_cast<std::size_t>(chunkRows(chunk));
  for (std::size_t row = 0; row < rows && walk.step(&scalars); ++row)
  {
    for (std::size_t f = 0; f < fields_.size(); ++f)
    {
      if (wanted[f])
      {
        gatherNumbers({ file_.map.data() + scalars[f], 0, *fields_[f].type, swapped_ }, 1,
          block.columns[f].data() + row);
      }
    }
  }
  file_.map.release(begin, walk.offset() - begin);
}

Result<void> PLYBinaryTable::read(
  std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const
{
  block.resize(static_cast<std::size_t>(chunkRows(chunk)), wanted);
  file_.pointElement().hasList() ? readListed(chunk, wanted, block)
                                 : readFixed(chunk, wanted, block);
  return file_.map.checkWhole();
}

} // namespace pointfront
