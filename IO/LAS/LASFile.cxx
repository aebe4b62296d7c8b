#include "LASFile.h"

#include "LASExtraBytes.h"

#include "pointfront/Base/PrintableText.h"
#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Points/GpsTimes.h"

#include <algorithm>
#include <utility>

namespace pointfront
{
namespace
{
/// One extra bytes record has room for 341; more are a damaged record length.
constexpr std::size_t mostExtraAttributes = 1000;

/// The records that go with the points into a store. Owner LASF_Spec 7 is "superseded"; those of
/// compressors and indices describe bytes of the file that a store does not have.
bool travels(const LASRecord& record)
{
  constexpr std::uint16_t superseded = 7;
  constexpr std::uint16_t waveformPackets = 65535; // bulk data, may be larger than the points
  return record.owner == "LASF_Projection" ||
    (record.owner == "LASF_Spec" && record.id != superseded && record.id != waveformPackets);
}

std::vector<MetadataRecord> metadataOf(
  const LASHeader& header, const std::vector<LASRecord>& records)
{
  std::vector<MetadataRecord> metadata;
  for (const LASRecord& record : records)
  {
    if (travels(record))
    {
      metadata.push_back({ record.owner, record.id, record.description,
        { record.payload.data, record.payload.data + record.payload.size } });
    }
  }
  std::vector<std::byte> encoding(sizeof header.globalEncoding);
  storeNumber(encoding.data(), header.globalEncoding);
  metadata.push_back({ lasKeptOwner, lasKeptEncodingRecord, "LAS global encoding", encoding });
  return metadata;
}

/// The first record that holds a CRS as WKT; "" without one.
std::string wktOf(const std::vector<LASRecord>& records, const char* owner)
{
  for (const LASRecord& record : records)
  {
    if (record.is(owner, lasWktRecord))
    {
      std::string wkt = printableText(loadText(record.payload.data, record.payload.size));
      if (wkt.find_first_not_of(' ') != std::string::npos)
      {
        return wkt;
      }
    }
  }
  return {};
}

/// The standard's record, else the one that libLAS wrote before the standard knew WKT; not beside
/// GeoTIFF keys, which are the standard's way to say it then.
std::string wktOf(const std::vector<LASRecord>& records)
{
  constexpr std::uint16_t geoKeyDirectory = 34735;
  constexpr std::size_t oneKey = 16; // bytes, with the directory's own four numbers
  std::string wkt = wktOf(records, "LASF_Projection");
  const bool keys = std::any_of(records.begin(), records.end(),
    [](const LASRecord& record)
    { return record.is("LASF_Projection", geoKeyDirectory) && record.payload.size >= oneKey; });
  return wkt.empty() && !keys ? wktOf(records, "liblas") : wkt;
}

/// Points and EVLRs that claim the same bytes: the points are what counts, unless their count
/// does not even fit into the file.
void dropOverlappingRecords(
  LASHeader& header, std::size_t fileBytes, std::vector<std::string>& warnings)
{
  const std::uint64_t begin = header.extendedRecordOffset;
  const std::uint64_t room = (fileBytes - header.pointOffset) / header.pointBytes;
  const bool countFits = !header.compressed && header.pointCount <= room;
  const std::uint64_t pointEnd =
    header.pointOffset + (countFits ? header.pointCount * header.pointBytes : 0);
  if (header.extendedRecordCount > 0 && begin < pointEnd)
  {
    warnings.push_back("The extended variable length records would begin at byte " +
      std::to_string(begin) + ", before the end of the points: " +
      std::to_string(header.extendedRecordCount) + " records were lost.");
    header.extendedRecordCount = 0;
  }
}

/// First bytes of a far file: header and records of most files, and the tables at the end of many.
/// Who opens many files knows better, and has fetched less.
constexpr std::size_t headBytes = std::size_t(64) << 10;
constexpr std::size_t headerBytes = 4096; ///< more than any header has
constexpr std::size_t tailBytes = std::size_t(256) << 10;
/// Extended records, up to the end of the file, that are read without a look at them. More are
/// mostly a COPC's hierarchy, of which its reader needs some pages.
constexpr std::uint64_t recordsAtOnceBytes = tailBytes;
/// More of them are read one after the other, a round trip each.
constexpr std::uint32_t mostFarRecords = 64;

/// Header and records of a far file; of extended ones behind each other the payload that travels.
Result<void> wantRecords(SparseBytes& far, const LASHeader& header)
{
  std::vector<HeldBytes::Part> parts;
  if (header.pointOffset > headerBytes)
  {
    parts.push_back({ headerBytes, header.pointOffset - headerBytes });
  }
  std::uint64_t at = header.extendedRecordCount > 0 ? header.extendedRecordOffset : far.size();
  const bool all = at < far.size() && far.size() - at <= recordsAtOnceBytes;
  if (all)
  {
    parts.push_back({ at, static_cast<std::size_t>(far.size() - at) });
  }
  Result<void> done = far.want(parts);
  for (std::uint32_t i = 0; done && !all && i < header.extendedRecordCount; ++i)
  {
    if (at > far.size() || far.size() - at < lasExtendedRecordHeaderBytes)
    {
      break; // readLASRecords() says what is lost
    }
    if (i == mostFarRecords)
    {
      return makeError(Error::Kind::Unsupported,
        "'" + far.source()->path() + "' has " + std::to_string(header.extendedRecordCount) +
          " extended variable length records, too many to read them from afar; copy the file");
    }
    done = far.want({ { at, lasExtendedRecordHeaderBytes } });
    const std::byte* const head = far.data() + at;
    const auto length = loadNumber<std::uint64_t>(head + 20);
    LASRecord record;
    record.owner = loadText(head + 2, 16);
    record.id = loadNumber<std::uint16_t>(head + 18);
    at += lasExtendedRecordHeaderBytes;
    const bool wanted = travels(record) || record.owner == "liblas";
    if (done && wanted)
    {
      done = far.want({ { at, static_cast<std::size_t>(std::min(length, far.size() - at)) } });
    }
    if (length > far.size() - at)
    {
      break;
    }
    at += length;
  }
  return done;
}

/// Points may reach to the EVLRs behind them, or to the end of the file.
std::uint64_t endOfPoints(const LASFile& file)
{
  return file.header.extendedRecordCount > 0
    ? std::min<std::uint64_t>(file.header.extendedRecordOffset, file.map.size())
    : file.map.size();
}

/// LAS 1.3 puts packets of waveforms behind the points, and its header counts no EVLR.
bool waveformsFollow(const LASHeader& header)
{
  constexpr std::uint16_t internalWaveforms = 2;
  return (header.globalEncoding & internalWaveforms) != 0;
}
} // namespace

Result<LASFile> LASFile::open(const std::string& path, MemoryMap::Access access)
{
  if (isAddress(path))
  {
    Result<std::shared_ptr<const ByteSource>> source = openBytes(path, { headBytes, tailBytes });
    return source ? of(std::move(*source)) : source.error();
  }
  Result<MemoryMap> map = MemoryMap::open(path, access);
  return map ? of(path, std::move(*map)) : map.error();
}

Result<LASFile> LASFile::of(std::shared_ptr<const ByteSource> source)
{
  const std::string path = source->path();
  const Result<std::shared_ptr<SparseBytes>> made = SparseBytes::over(std::move(source));
  if (!made)
  {
    return made.error();
  }
  SparseBytes& far = **made;
  if (Result<void> done = far.want({ { 0, headerBytes } }); !done)
  {
    return done.error();
  }
  std::vector<std::string> warnings; // told when the file is read as a whole
  const Result<LASHeader> header = parseLASHeader({ far.data(), far.size() }, path, warnings);
  if (!header)
  {
    return header.error();
  }
  if (Result<void> done = wantRecords(far, *header); !done)
  {
    return done.error();
  }
  Result<LASFile> file = of(path, MemoryMap::ofBytes(path, far.data(), far.size()));
  if (file)
  {
    file->far = *made;
  }
  return file;
}

Result<LASFile> LASFile::of(const std::string& path, MemoryMap map)
{
  std::vector<std::string> warnings;
  const ByteSpan bytes{ map.data(), map.size() };
  Result<LASHeader> parsed = parseLASHeader(bytes, path, warnings);
  if (!parsed)
  {
    return parsed.error();
  }
  LASHeader header = *parsed;
  dropOverlappingRecords(header, bytes.size, warnings);
  std::vector<LASRecord> records = readLASRecords(bytes, header, warnings);

  std::vector<ByteSpan> descriptors;
  for (const LASRecord& record : records)
  {
    if (record.is("LASF_Spec", lasExtraBytesRecord))
    {
      descriptors.push_back(record.payload);
    }
  }
  const std::size_t extra = header.pointBytes - lasMinimumPointBytes(header.pointFormat);
  const std::vector<Attribute> attributes = parseExtraBytes(descriptors, extra, warnings);
  if (attributes.size() > mostExtraAttributes)
  {
    return makeError(Error::Kind::Unsupported,
      path + ": " + std::to_string(attributes.size()) + " extra attributes a point (" +
        std::to_string(extra) + " bytes) are more than the " + std::to_string(mostExtraAttributes) +
        " that are read");
  }
  if (Result<void> whole = map.checkWhole(); !whole)
  {
    return whole.error();
  }
  LASPointLayout layout = makeLASPointLayout(header.pointFormat, attributes);

  SourceDescription description;
  description.path = path;
  description.format = std::string(header.compressed ? "LAZ " : "LAS ") + header.versionText() +
    " format " + std::to_string(header.pointFormat);
  description.pointCount = header.pointCount;
  description.headerPointCount = header.pointCount;
  description.declaredBounds = header.bounds;
  description.grid = header.grid;
  description.schema = layout.schema;
  description.crsWkt = wktOf(records);
  description.metadata = metadataOf(header, records);
  description.warnings = std::move(warnings);
  return LASFile{ std::move(map), header, std::move(records), std::move(layout),
    std::move(description) };
}

Result<void> LASFile::countRecords()
{
  const std::uint64_t claimed = header.pointCount;
  const std::uint64_t room = endOfPoints(*this) - header.pointOffset;
  const std::uint64_t present = std::min(claimed, room / header.pointBytes);
  if (present < claimed)
  {
    const std::string where = "their bytes end at byte " + std::to_string(endOfPoints(*this));
    if (present == 0)
    {
      return makeError(Error::Kind::Truncated,
        description.path + ": the header promises " + std::to_string(claimed) +
          " points from byte " + std::to_string(header.pointOffset) + " on, but " + where +
          ": there is none; get a whole copy");
    }
    description.warnings.push_back(std::to_string(claimed - present) + " of " +
      std::to_string(claimed) + " points are missing: " + where + ", after " +
      std::to_string(present) + " whole points.");
  }
  if (const std::uint64_t more = room / header.pointBytes - present;
      more > 0 && description.warnings.empty() && !waveformsFollow(header))
  {
    description.warnings.push_back("The header promises " + std::to_string(claimed) +
      " points; behind them " + std::to_string(room - present * header.pointBytes) +
      " bytes follow, room for " + std::to_string(more) +
      " more, which were left out: they may be points that the header does not count.");
  }
  description.pointCount = present;
  return {};
}

} // namespace pointfront
