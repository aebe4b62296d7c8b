#include "LASHeader.h"

#include "LASPointLayout.h"

#include "pointfront/Base/NumberText.h"

#include <algorithm>
#include <cmath>

namespace pointfront
{
namespace
{
/// Byte offsets of the fields that are read, in every version.
enum Field : std::size_t
{
  GlobalEncoding = 6,
  VersionMajor = 24,
  VersionMinor = 25,
  HeaderSize = 94,
  PointOffset = 96,
  RecordCount = 100,
  PointFormat = 104,
  PointBytes = 105,
  LegacyPointCount = 107,
  Scale = 131,
  Offset = 155,
  MaxX = 179,
  ExtendedRecordOffset = 235, ///< this and the following: LAS 1.4
  ExtendedRecordCount = 243,
  PointCount = 247
};

std::string at(std::size_t byte)
{
  return " (byte " + std::to_string(byte) + ")";
}

std::string exactText(double value)
{
  return numberText(value, 17);
}

Result<void> readGrid(const std::byte* bytes, const std::string& path, LASHeader& header)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::size_t scaleField = Scale + 8 * static_cast<std::size_t>(axis);
    const std::size_t offsetField = Offset + 8 * static_cast<std::size_t>(axis);
    const double scale = loadNumber<double>(bytes + scaleField);
    const double offset = loadNumber<double>(bytes + offsetField);
    const std::string name(1, "xyz"[axis]);
    if (!std::isfinite(scale) || scale <= 0.0)
    {
      return makeError(Error::Kind::BadFormat,
        path + ": the " + name + " scale is " + exactText(scale) + at(scaleField) +
          ", it must be a number above 0; write the file again with a valid header");
    }
    if (!std::isfinite(offset) || !exactInDouble(scale, offset))
    {
      return makeError(Error::Kind::BadFormat,
        path + ": the " + name + " offset is " + exactText(offset) + at(offsetField) +
          ", which double precision cannot hold in steps of " + exactText(scale) +
          "; write the file again with a valid header");
    }
    if (std::abs(offset) + 2147483648.0 * scale > farthestCoordinate)
    {
      return makeError(Error::Kind::BadFormat,
        path + ": the " + name + " scale is " + exactText(scale) + at(scaleField) +
          ", so that coordinates may reach beyond " + exactText(farthestCoordinate) +
          "; write the file again with a valid header");
    }
    header.grid.scale[axis] = scale;
    header.grid.offset[axis] = offset;
  }
  return {};
}

/// The box is a hint: one that is no box is left out, with a warning; six zeros are a header that
/// nobody filled in.
void readBounds(const std::byte* bytes, LASHeader& header, std::vector<std::string>& warnings)
{
  Bounds box;
  for (int axis = 0; axis < 3; ++axis)
  {
    const std::size_t maxAt = MaxX + 16 * static_cast<std::size_t>(axis);
    box.high[axis] = loadNumber<double>(bytes + maxAt);
    box.low[axis] = loadNumber<double>(bytes + maxAt + 8);
    const bool finite = std::isfinite(box.high[axis]) && std::isfinite(box.low[axis]);
    if (!finite || box.low[axis] > box.high[axis])
    {
      if (header.pointCount > 0)
      {
        warnings.push_back(std::string("The header's bounding box has a maximum ") + "xyz"[axis] +
          " of " + exactText(box.high[axis]) + " and a minimum of " + exactText(box.low[axis]) +
          at(maxAt) + ": it was ignored, no point was lost.");
      }
      return;
    }
  }
  const bool givenAtAll = box.low != glm::dvec3(0.0) || box.high != glm::dvec3(0.0);
  header.bounds = givenAtAll ? box : Bounds();
}

/// LAS 1.4 has two counts. Files that set both for point formats 6 and above are out of the
/// standard but common.
void readCounts(const std::byte* bytes, LASHeader& header, std::vector<std::string>& warnings)
{
  const std::uint64_t legacy = loadNumber<std::uint32_t>(bytes + LegacyPointCount);
  header.pointCount = legacy;
  if (header.versionMinor < 4)
  {
    return;
  }
  const std::uint64_t count = loadNumber<std::uint64_t>(bytes + PointCount);
  if (count != 0)
  {
    header.pointCount = count;
  }
  if (count != 0 && legacy != 0 && legacy != count)
  {
    warnings.push_back("The header has two point counts, " + std::to_string(legacy) + at(107) +
      " and " + std::to_string(count) + at(247) + ": the second was used.");
  }
  header.extendedRecordOffset = loadNumber<std::uint64_t>(bytes + ExtendedRecordOffset);
  header.extendedRecordCount = loadNumber<std::uint32_t>(bytes + ExtendedRecordCount);
}

/// LAS 1.5: GPS times may count from another second than 10^9. Values are kept as they stand.
void readTimeOffset(
  const std::byte* bytes, const LASHeader& header, std::vector<std::string>& warnings)
{
  constexpr std::size_t timeOffset = 391; // millions of seconds
  constexpr std::uint16_t offsetTimeBit = 64;
  constexpr int usual = 1000;
  const bool has = header.versionMinor >= 5 && header.headerBytes >= timeOffset + 2 &&
    (header.globalEncoding & offsetTimeBit) != 0;
  const int millions = has ? loadNumber<std::int16_t>(bytes + timeOffset) : usual;
  if (millions != usual)
  {
    warnings.push_back("Its GPS times count from second " + std::to_string(millions) +
      " million of GPS time, not from 1000 million as those of other files: they are kept as they "
      "stand.");
  }
}

Result<void> checkVersion(const std::byte* bytes, const std::string& path, LASHeader& header)
{
  const auto major = loadNumber<std::uint8_t>(bytes + VersionMajor);
  const auto minor = loadNumber<std::uint8_t>(bytes + VersionMinor);
  if (major != 1 || minor > 5)
  {
    return makeError(Error::Kind::Unsupported,
      path + ": LAS version " + std::to_string(major) + "." + std::to_string(minor) +
        at(VersionMajor) + " is not one of 1.0 to 1.5");
  }
  header.versionMinor = minor;
  return {};
}

Result<void> readPointFormat(const std::byte* bytes, const std::string& path, LASHeader& header)
{
  // LASzip marks compressed points by bit 7; bit 6 was used by its versions before 1.0.
  const auto format = loadNumber<std::uint8_t>(bytes + PointFormat);
  header.compressed = (format & 0x80) != 0;
  header.pointFormat = format & 0x3F;
  header.pointBytes = loadNumber<std::uint16_t>(bytes + PointBytes);
  if ((format & 0x40) != 0)
  {
    return makeError(Error::Kind::Unsupported,
      path + ": points compressed by a LASzip older than 1.0" + at(PointFormat) +
        "; decompress with the program that wrote it");
  }
  if (header.pointFormat > lasHighestPointFormat)
  {
    return makeError(Error::Kind::Unsupported,
      path + ": point format " + std::to_string(header.pointFormat) + at(PointFormat) +
        " does not exist, LAS has 0 to 10");
  }
  if (header.pointBytes < lasMinimumPointBytes(header.pointFormat))
  {
    return makeError(Error::Kind::BadFormat,
      path + ": point records of " + std::to_string(header.pointBytes) + " bytes" + at(PointBytes) +
        " are too short for point format " + std::to_string(header.pointFormat) + ", which needs " +
        std::to_string(lasMinimumPointBytes(header.pointFormat)));
  }
  return {};
}

Result<void> readSizes(ByteSpan file, const std::string& path, LASHeader& header)
{
  header.headerBytes = loadNumber<std::uint16_t>(file.data + HeaderSize);
  header.pointOffset = loadNumber<std::uint32_t>(file.data + PointOffset);
  header.recordCount = loadNumber<std::uint32_t>(file.data + RecordCount);
  const std::size_t needed = header.versionMinor >= 4 ? lasHeaderBytes14 : lasHeaderBytes12;
  if (header.headerBytes < needed)
  {
    return makeError(Error::Kind::BadFormat,
      path + ": a header of " + std::to_string(header.headerBytes) + " bytes" + at(HeaderSize) +
        " is too short for LAS " + header.versionText() + ", which needs " +
        std::to_string(needed));
  }
  if (file.size < header.headerBytes)
  {
    return makeError(Error::Kind::Truncated,
      path + ": the file ends at byte " + std::to_string(file.size) + ", inside its header of " +
        std::to_string(header.headerBytes) + " bytes; get a whole copy");
  }
  if (header.pointOffset < header.headerBytes)
  {
    return makeError(Error::Kind::BadFormat,
      path + ": points at byte " + std::to_string(header.pointOffset) + at(PointOffset) +
        " would lie inside the header of " + std::to_string(header.headerBytes) + " bytes");
  }
  if (header.pointOffset > file.size)
  {
    return makeError(Error::Kind::Truncated,
      path + ": points should begin at byte " + std::to_string(header.pointOffset) +
        at(PointOffset) + ", but the file ends at byte " + std::to_string(file.size) +
        "; get a whole copy");
  }
  return {};
}
} // namespace

bool exactInDouble(double scale, double offset)
{
  constexpr double steps = 2251799813685248.0; // 2^51, see QuantisationGrid
  return std::abs(offset) / scale + 2147483648.0 < steps;
}

Result<LASHeader> parseLASHeader(
  ByteSpan file, const std::string& path, std::vector<std::string>& warnings)
{
  if (file.size == 0)
  {
    return makeError(Error::Kind::BadFormat, path + ": the file is empty (0 bytes)");
  }
  if (file.size < 4 || std::memcmp(file.data, "LASF", 4) != 0)
  {
    return makeError(
      Error::Kind::BadFormat, path + ": not a LAS file, it does not begin with \"LASF\" (byte 0)");
  }
  if (file.size < lasHeaderBytes12)
  {
    return makeError(Error::Kind::Truncated,
      path + ": the file ends at byte " + std::to_string(file.size) +
        ", inside its header, which has at least 227 bytes; get a whole copy");
  }
  LASHeader header;
  header.globalEncoding = loadNumber<std::uint16_t>(file.data + GlobalEncoding);
  if (auto done = checkVersion(file.data, path, header); !done)
  {
    return done.error();
  }
  if (auto done = readSizes(file, path, header); !done)
  {
    return done.error();
  }
  if (auto done = readPointFormat(file.data, path, header); !done)
  {
    return done.error();
  }
  if (auto done = readGrid(file.data, path, header); !done)
  {
    return done.error();
  }
  readCounts(file.data, header, warnings);
  readTimeOffset(file.data, header, warnings);
  readBounds(file.data, header, warnings);
  return header;
}

} // namespace pointfront
