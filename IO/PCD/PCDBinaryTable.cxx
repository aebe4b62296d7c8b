#include "PCDBinaryTable.h"

#include "LZFDecoder.h"

#include "pointfront/Table/RecordNumbers.h"

#include <algorithm>
#include <cassert>
#include <filesystem>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::uint64_t pointsPerChunk = 32768;
constexpr std::uint64_t mostInMemory = 64ull << 20;
constexpr std::size_t sizesBytes = 8; // packed and unpacked size before the block
constexpr std::uint64_t mostExpansion = 264 / 3; // LZF's limit: 264 bytes from three

std::uint32_t littleEndian32(const std::byte* from)
{
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i)
  {
    value = value << 8 | std::to_integer<std::uint32_t>(from[i]);
  }
  return value;
}

/// PCD files are little endian.
bool machineIsBigEndian()
{
  return !machineIsLittleEndian();
}
} // namespace

Result<void> PCDBinaryTable::locateRecords()
{
  std::uint64_t offset = 0;
  for (const PCDField& field : file_.header.fields)
  {
    fieldBegins_.push_back(offset);
    offset += field.bytes();
  }
  const std::uint64_t room = file_.map.size() - file_.header.dataOffset;
  Result<std::uint64_t> present = file_.countPresent(room / offset);
  if (!present)
  {
    return present.error();
  }
  points_ = *present;
  return {};
}

Result<void> PCDBinaryTable::decode(
  const std::byte* block, std::size_t blockBytes, std::uint64_t bytes, bool spilled)
{
  std::uint64_t written = 0;
  const auto write = [&](const std::byte* from, std::size_t count) -> Result<void>
  {
    if (spilled)
    {
      Result<void> done = spilled_->write(written, from, count);
      written += count;
      return done;
    }
    columns_.insert(columns_.end(), from, from + count);
    return {};
  };
  if (Result<void> done = decodeLZF(block, blockBytes, bytes, write); !done)
  {
    return makeError(done.error().kind, file_.path + ": " + done.error().what);
  }
  return {};
}

Result<void> PCDBinaryTable::unpack(const std::string& temporaryFolder)
{
  points_ = file_.header.points;
  const std::size_t begin = file_.header.dataOffset;
  const std::size_t room = file_.map.size() - begin;
  if (points_ == 0)
  {
    return {};
  }
  if (room < sizesBytes)
  {
    return makeError(Error::Kind::Truncated,
      file_.path + ": the file ends before the block of points; get a whole copy");
  }
  const std::uint64_t packed = littleEndian32(file_.map.data() + begin);
  const std::uint64_t unpacked = littleEndian32(file_.map.data() + begin + 4);
  if (packed > room - sizesBytes)
  {
    return makeError(Error::Kind::Truncated,
      file_.path + ": the compressed block of " + std::to_string(packed) + " bytes ends after " +
        std::to_string(room - sizesBytes) + "; get a whole copy");
  }
  if (Result<void> done = locateFields(packed, unpacked); !done)
  {
    return done.error();
  }
  const bool spilled = unpacked > mostInMemory;
  if (spilled)
  {
    std::error_code none;
    const std::string folder = temporaryFolder.empty()
      ? std::filesystem::temp_directory_path(none).string()
      : temporaryFolder;
    Result<std::unique_ptr<SpillFile>> file = SpillFile::create(folder, unpacked);
    if (!file)
    {
      return file.error();
    }
    spilled_ = std::move(*file);
  }
  const std::byte* block = file_.map.data() + begin + sizesBytes;
  Result<void> done = decode(block, static_cast<std::size_t>(packed), unpacked, spilled);
  file_.map.release(begin, static_cast<std::size_t>(packed));
  return file_.map.checkWhole(done);
}

/// Where the fields of all points begin in a block that unpacks to so many bytes.
Result<void> PCDBinaryTable::locateFields(std::uint64_t packed, std::uint64_t unpacked)
{
  std::uint64_t pointBytes = file_.header.pointBytes();
  std::uint64_t padding = 0;
  for (const PCDField& field : file_.header.fields)
  {
    padding += field.isPadding() ? field.bytes() : 0;
  }
  // PCL's writer names padding in the header and leaves it out of the block.
  const bool withPadding = unpacked / pointBytes == points_ && unpacked % pointBytes == 0;
  pointBytes -= withPadding ? 0 : padding;
  if (pointBytes == 0 || unpacked / pointBytes != points_ || unpacked % pointBytes != 0 ||
    unpacked > packed * mostExpansion)
  {
    return makeError(Error::Kind::BadFormat,
      file_.path + ": a compressed block that unpacks from " + std::to_string(packed) + " to " +
        std::to_string(unpacked) + " bytes cannot hold the " + std::to_string(points_) +
        " points that the header promises");
  }
  std::uint64_t offset = 0;
  for (const PCDField& field : file_.header.fields)
  {
    fieldBegins_.push_back(offset);
    offset += field.isPadding() && !withPadding ? 0 : field.bytes() * points_;
  }
  return {};
}

Result<std::unique_ptr<PointTable>> PCDBinaryTable::open(
  PCDFile file, const std::string& temporaryFolder)
{
  auto table = std::unique_ptr<PCDBinaryTable>(new PCDBinaryTable(std::move(file)));
  const bool packed = table->file_.header.encoding == PCDEncoding::BinaryCompressed;
  if (Result<void> done = packed ? table->unpack(temporaryFolder) : table->locateRecords(); !done)
  {
    return done.error();
  }
  return std::unique_ptr<PointTable>(std::move(table));
}

std::uint64_t PCDBinaryTable::chunkCount() const
{
  return (points_ + pointsPerChunk - 1) / pointsPerChunk;
}

std::uint64_t PCDBinaryTable::chunkRows(std::uint64_t chunk) const
{
  assert(chunk < chunkCount());
  return std::min(pointsPerChunk, points_ - chunk * pointsPerChunk);
}

namespace
{
/// The wanted column of a field.
void gatherColumn(const RecordNumbers& numbers, std::size_t field, TableBlock& block)
{
  std::vector<double>& column = block.columns[field];
  gatherNumbers(numbers, column.size(), column.data());
  if (wantsWholes(numbers.type))
  {
    gatherWholes(numbers, column.size(), block.wholesOf(field).data());
  }
}
} // namespace

void PCDBinaryTable::readRecords(
  std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const
{
  const std::size_t stride = file_.header.pointBytes();
  const auto count = static_cast<std::size_t>(chunkRows(chunk));
  const std::size_t begin =
    file_.header.dataOffset + static_cast<std::size_t>(chunk * pointsPerChunk) * stride;
  for (std::size_t f = 0; f < wanted.size(); ++f)
  {
    if (wanted[f])
    {
      const PCDFile::Element& element = file_.elements[f];
      const std::size_t offset =
        begin + static_cast<std::size_t>(fieldBegins_[element.field]) + element.byte;
      gatherColumn(
        { file_.map.data() + offset, stride, element.type, machineIsBigEndian() }, f, block);
    }
  }
  file_.map.release(begin, count * stride);
}

Result<void> PCDBinaryTable::readColumns(
  std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const
{
  const auto count = static_cast<std::size_t>(chunkRows(chunk));
  std::vector<std::byte> read;
  for (std::size_t f = 0; f < wanted.size(); ++f)
  {
    if (!wanted[f])
    {
      continue;
    }
    const PCDFile::Element& element = file_.elements[f];
    const std::size_t stride = file_.header.fields[element.field].bytes();
    const std::uint64_t begin = fieldBegins_[element.field] + chunk * pointsPerChunk * stride;
    const std::byte* first = columns_.data() + (spilled_ ? 0 : begin);
    if (spilled_)
    {
      read.resize(count * stride);
      if (Result<void> done = spilled_->read(begin, read.data(), read.size()); !done)
      {
        return done;
      }
      first = read.data();
    }
    gatherColumn({ first + element.byte, stride, element.type, machineIsBigEndian() }, f, block);
  }
  return {};
}

Result<void> PCDBinaryTable::read(
  std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const
{
  block.resize(static_cast<std::size_t>(chunkRows(chunk)), wanted);
  if (file_.header.encoding == PCDEncoding::BinaryCompressed)
  {
    return readColumns(chunk, wanted, block);
  }
  readRecords(chunk, wanted, block);
  return file_.map.checkWhole();
}

} // namespace pointfront
