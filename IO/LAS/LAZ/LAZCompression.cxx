#include "LAZCompression.h"

namespace pointfront
{
namespace
{
constexpr std::uint16_t compressionRecord = 22204;

/// Offsets in the payload of the compression record; items of 6 bytes follow.
constexpr std::size_t coderAt = 2;
constexpr std::size_t chunkSizeAt = 12;
constexpr std::size_t itemCountAt = 32;
constexpr std::size_t itemsAt = 34;
constexpr std::size_t itemBytes = 6;

enum ItemType : std::uint16_t
{
  Byte = 0,
  Point10 = 6,
  GpsTime11 = 7,
  Rgb12 = 8,
  WavePacket13 = 9,
  Point14 = 10,
  Rgb14 = 11,
  RgbNir14 = 12,
  WavePacket14 = 13,
  Byte14 = 14
};

/// The only list of items that a point format may have. LASzip trusts the list with its memory.
std::vector<LAZCompression::Item> itemsOf(int format, std::size_t extraBytes)
{
  std::vector<LAZCompression::Item> items;
  const auto add = [&items](ItemType type, std::size_t bytes) {
    items.push_back({ type, static_cast<std::uint16_t>(bytes), 0 });
  };
  const LASFormatParts& parts = lasFormatParts(format);
  const bool legacy = format < 6;
  legacy ? add(Point10, 20) : add(Point14, 30);
  if (legacy && parts.gpsTime != 0)
  {
    add(GpsTime11, 8);
  }
  if (parts.nir != 0)
  {
    add(RgbNir14, 8);
  }
  else if (parts.rgb != 0)
  {
    add(legacy ? Rgb12 : Rgb14, 6);
  }
  if (parts.wave != 0)
  {
    add(legacy ? WavePacket13 : WavePacket14, 29);
  }
  if (extraBytes > 0)
  {
    add(legacy ? Byte : Byte14, extraBytes);
  }
  return items;
}

/// Versions of an item's code that LASzip 3.4 reads. (It refuses others too, but loses memory.)
bool versionIsKnown(const LAZCompression::Item& item)
{
  switch (item.type)
  {
    case WavePacket13:
      return item.version == 1;
    case WavePacket14:
      return item.version == 3 || item.version == 4;
    case Point14:
    case Rgb14:
    case RgbNir14:
    case Byte14:
      return item.version >= 2 && item.version <= 4;
    default:
      return item.version == 1 || item.version == 2;
  }
}

std::string describe(const LAZCompression::Item& item)
{
  return "type " + std::to_string(item.type) + " of " + std::to_string(item.bytes) + " bytes";
}

Result<void> checkItems(const LASFile& file, const LAZCompression& compression)
{
  const int format = file.header.pointFormat;
  const std::size_t extra = file.header.pointBytes - lasMinimumPointBytes(format);
  const std::vector<LAZCompression::Item> expected = itemsOf(format, extra);
  const std::string& path = file.description.path;
  if (compression.items.size() != expected.size())
  {
    return makeError(Error::Kind::BadFormat,
      path + ": points of format " + std::to_string(format) + " are compressed in " +
        std::to_string(expected.size()) + " items, the compression record lists " +
        std::to_string(compression.items.size()));
  }
  for (std::size_t i = 0; i < expected.size(); ++i)
  {
    const LAZCompression::Item& item = compression.items[i];
    if (item.type != expected[i].type || item.bytes != expected[i].bytes)
    {
      return makeError(Error::Kind::BadFormat,
        path + ": compressed item " + std::to_string(i + 1) + " is " + describe(item) +
          ", point format " + std::to_string(format) + " needs " + describe(expected[i]));
    }
    if (!versionIsKnown(item))
    {
      return makeError(Error::Kind::Unsupported,
        path + ": compressed item " + std::to_string(i + 1) + " (" + describe(item) +
          ") has version " + std::to_string(item.version) +
          ", which LASzip does not read; compress the file again");
    }
  }
  return {};
}

Result<void> checkScheme(const LASFile& file, std::uint16_t scheme, std::uint16_t coder)
{
  const bool legacy = file.header.pointFormat < 6;
  const bool known = legacy ? scheme == 1 || scheme == 2 : scheme == 3;
  if (!known || coder != 0)
  {
    return makeError(Error::Kind::Unsupported,
      file.description.path + ": compressor " + std::to_string(scheme) + " with coder " +
        std::to_string(coder) + " is not one for point format " +
        std::to_string(file.header.pointFormat));
  }
  return {};
}
} // namespace

std::size_t LAZCompression::layers() const
{
  std::size_t sum = 0;
  for (const Item& item : items)
  {
    switch (item.type)
    {
      case Point14:
        sum += 9;
        break;
      case RgbNir14:
        sum += 2;
        break;
      case Byte14:
        sum += item.bytes;
        break;
      default:
        sum += 1;
    }
  }
  return sum;
}

Result<LAZCompression> LAZCompression::of(const LASFile& file)
{
  const std::string& path = file.description.path;
  const LASRecord* record = nullptr;
  for (const LASRecord& candidate : file.records)
  {
    record = candidate.is("laszip encoded", compressionRecord) ? &candidate : record;
  }
  if (record == nullptr)
  {
    return makeError(Error::Kind::BadFormat,
      path +
        ": the points are marked as compressed (byte 104), but the record \"laszip "
        "encoded\" that says how is missing");
  }
  const ByteSpan payload = record->payload;
  const std::size_t count =
    payload.size < itemsAt ? 0 : loadNumber<std::uint16_t>(payload.data + itemCountAt);
  if (payload.size < itemsAt || payload.size < itemsAt + count * itemBytes)
  {
    return makeError(Error::Kind::BadFormat,
      path + ": the compression record has " + std::to_string(payload.size) +
        " bytes, too few for its " + std::to_string(count) + " items");
  }
  const auto scheme = loadNumber<std::uint16_t>(payload.data);
  if (auto done = checkScheme(file, scheme, loadNumber<std::uint16_t>(payload.data + coderAt));
      !done)
  {
    return done.error();
  }
  LAZCompression compression;
  compression.scheme = static_cast<Scheme>(scheme);
  compression.chunkPoints = loadNumber<std::uint32_t>(payload.data + chunkSizeAt);
  for (std::size_t i = 0; i < count; ++i)
  {
    const std::byte* item = payload.data + itemsAt + i * itemBytes;
    compression.items.push_back({ loadNumber<std::uint16_t>(item),
      loadNumber<std::uint16_t>(item + 2), loadNumber<std::uint16_t>(item + 4) });
  }
  if (auto done = checkItems(file, compression); !done)
  {
    return done.error();
  }
  if (compression.scheme == Scheme::Layered && compression.chunkPoints == 0)
  {
    compression.chunkPoints = variableChunks; // COPC writers say so: the chunk table knows
  }
  if (compression.scheme != Scheme::Pointwise && compression.chunkPoints == 0)
  {
    return makeError(
      Error::Kind::BadFormat, path + ": the compression record has chunks of 0 points");
  }
  compression.record.assign(payload.data, payload.data + itemsAt + count * itemBytes);
  return compression;
}

std::vector<std::byte> composeLAZBeginning(
  const LASFile& file, const LAZCompression& compression, std::uint32_t points)
{
  const std::size_t recordAt = lasHeaderBytes14;
  const std::size_t pointsAt = recordAt + lasRecordHeaderBytes + compression.record.size();
  std::vector<std::byte> bytes(pointsAt + 8);
  std::byte* to = bytes.data();
  std::memcpy(to, "LASF", 4);
  storeNumber<std::uint8_t>(to + 24, 1); // version 1.4
  storeNumber<std::uint8_t>(to + 25, 4);
  storeNumber(to + 94, static_cast<std::uint16_t>(lasHeaderBytes14));
  storeNumber(to + 96, static_cast<std::uint32_t>(pointsAt));
  storeNumber<std::uint32_t>(to + 100, 1); // one record
  storeNumber(to + 104, static_cast<std::uint8_t>(0x80 | file.header.pointFormat));
  storeNumber(to + 105, file.header.pointBytes);
  storeNumber(to + 107, points);
  for (const std::size_t scaleAt : { 131, 139, 147 })
  {
    storeNumber(to + scaleAt, 1.0); // only integers are asked for
  }
  storeNumber<std::uint64_t>(to + 247, points);

  storeText(to + recordAt + 2, 16, "laszip encoded");
  storeNumber(to + recordAt + 18, compressionRecord);
  storeNumber(to + recordAt + 20, static_cast<std::uint16_t>(compression.record.size()));
  std::byte* record = to + recordAt + lasRecordHeaderBytes;
  std::memcpy(record, compression.record.data(), compression.record.size());
  if (compression.scheme == LAZCompression::Scheme::Pointwise)
  {
    bytes.resize(pointsAt);
    return bytes;
  }
  storeNumber(record + chunkSizeAt, points);
  // A table that begins where its own address lies: "the writer was interrupted", LASzip then
  // reads chunks as they come.
  storeNumber(to + pointsAt, static_cast<std::uint64_t>(pointsAt));
  return bytes;
}

} // namespace pointfront
