#include "LASExport.h"

#include "LASExtraBytes.h"
#include "LASFieldChoice.h"
#include "LASFile.h"
#include "LASHeader.h"
#include "LASRecords.h"

#include "pointfront/Base/NumberText.h"
#include "pointfront/Points/GpsTimes.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <limits>

namespace pointfront
{
namespace
{
constexpr std::uint16_t geoKeysRecord = 34735;
constexpr std::size_t mostRecordPayload = 65535;

/// Facts of the description that the format depends on.
struct Needs
{
  const SinkDescription& description;
  bool copc = false;

  std::optional<std::size_t> column(const char* name) const
  {
    const AttributeSchema& schema = description.schema;
    for (std::size_t c = 0; c < schema.size(); ++c)
    {
      if (schema[c].name == name)
      {
        return c;
      }
    }
    return std::nullopt;
  }
  bool has(const char* name) const { return column(name).has_value(); }
  bool exceeds(const char* name, double limit) const
  {
    const std::optional<std::size_t> c = column(name);
    return c && *c < description.largest.size() && description.largest[*c] > limit;
  }
  bool modern() const
  {
    return copc || has("scanner_channel") || has("nir") || exceeds("classification", 31) ||
      exceeds("classification_flags", 7) || exceeds("return_number", 7) ||
      exceeds("return_count", 7) || hasFineAngles(description);
  }
  const MetadataRecord* record(const char* owner, std::uint16_t id) const
  {
    for (const MetadataRecord& candidate : description.metadata)
    {
      if (candidate.owner == owner && candidate.id == id)
      {
        return &candidate;
      }
    }
    return nullptr;
  }
};

int pointFormatFor(const Needs& needs)
{
  const bool rgb = needs.has("rgb");
  const bool wave = needs.has("wave_descriptor") && !needs.copc;
  if (!needs.modern())
  {
    if (wave)
    {
      return rgb ? 5 : 4;
    }
    return (rgb ? 2 : 0) + (needs.has("gps_time") ? 1 : 0);
  }
  const bool nir = needs.has("nir");
  if (wave)
  {
    return rgb || nir ? 10 : 9;
  }
  return nir ? 8 : (rgb ? 7 : 6);
}

constexpr double steps32 = std::numeric_limits<std::uint32_t>::max(); ///< that integers reach over

/// Gives an axis of transformed coordinates, which lie on no grid, the finest decimal step with
/// which 32 bits reach over the extent.
/// Errors  BadArgument: it would round by more than the step that they had before.
Result<void> coarsenStep(
  const SinkDescription& description, const std::string& path, int axis, LASExport& plan)
{
  constexpr int digits = 9;
  const double extent = description.bounds.size()[axis];
  const double before = description.stepBefore[axis];
  const double step = std::pow(10.0, std::ceil(std::log10(extent / (steps32 - 2.0))));
  const std::string name(1, "xyz"[axis]);
  if (0.5 * step > before)
  {
    return makeError(Error::Kind::BadArgument,
      path + ": the extent in " + name + " is " + numberText(extent, digits) + ", and " +
        numberText(step, digits) +
        " is the finest step with which the 32 bits of LAS reach over it, which would round by "
        "more than the step that the coordinates had before they were transformed, " +
        numberText(before, digits) +
        "; export a part of it (--box), or into text (.csv, .xyz), which has all digits");
  }
  if (step > before)
  {
    plan.changes.push_back("The step of " + name + " is " + numberText(step, digits) +
      ", the finest with which the 32 bits of LAS reach over the extent; before the coordinates "
      "were transformed, it was " +
      numberText(before, digits) + ".");
  }
  plan.grid.scale[axis] = step;
  return {};
}

/// The grid of the description, its offset moved by whole steps if integers of 32 bits would not
/// reach all of `bounds`.
Result<void> placeGrid(const SinkDescription& description, const std::string& path, LASExport& plan)
{
  plan.grid = description.grid;
  if (description.bounds.empty())
  {
    return {};
  }
  constexpr double lowest = std::numeric_limits<std::int32_t>::min();
  constexpr double highest = std::numeric_limits<std::int32_t>::max();
  for (int axis = 0; axis < 3; ++axis)
  {
    if (description.stepBefore[axis] > 0.0 &&
      description.bounds.size()[axis] / plan.grid.scale[axis] > steps32)
    {
      if (Result<void> done = coarsenStep(description, path, axis, plan); !done)
      {
        return done;
      }
    }
    const double scale = plan.grid.scale[axis];
    const double low = std::round((description.bounds.low[axis] - plan.grid.offset[axis]) / scale);
    const double high =
      std::round((description.bounds.high[axis] - plan.grid.offset[axis]) / scale);
    if (high - low > highest - lowest)
    {
      return makeError(Error::Kind::BadArgument,
        path + ": the extent in " + "xyz"[axis] + " is " + numberText((high - low) * scale, 9) +
          ", LAS has 32 bits for it at a step of " + numberText(scale, 9) +
          "; export a part of it, or build with a coarser precision");
    }
    if (low < lowest || high > highest)
    {
      plan.grid.offset[axis] += std::ceil(0.5 * (low + high)) * scale;
    }
    if (!exactInDouble(scale, plan.grid.offset[axis]))
    {
      return makeError(Error::Kind::BadArgument,
        path + ": double precision cannot hold an offset in " + "xyz"[axis] + " of " +
          std::to_string(plan.grid.offset[axis]) +
          " and the steps of this cloud; build it with a " + "coarser precision");
    }
  }
  return {};
}

MetadataRecord record(
  const char* owner, std::uint16_t id, const char* what, std::vector<std::byte> payload)
{
  return { owner, id, what, std::move(payload) };
}

/// A record that a COPC file must not have, or has anew.
bool isForeignToCOPC(const MetadataRecord& candidate)
{
  constexpr std::uint16_t geoTextRecord = geoKeysRecord + 2;
  const bool geoKeys = candidate.owner == "LASF_Projection" && candidate.id >= geoKeysRecord &&
    candidate.id <= geoTextRecord;
  return geoKeys || candidate.owner == "copc" || candidate.owner == "laszip encoded";
}

/// CRS and the other records that came with the points, each once; the extra bytes' new.
void collectRecords(const Needs& needs, const std::vector<Attribute>& extra, LASExport& plan)
{
  std::vector<MetadataRecord> all;
  std::vector<ByteSpan> descriptors;
  for (const MetadataRecord& candidate : needs.description.metadata)
  {
    const bool taken = std::any_of(all.begin(), all.end(),
      [&](const MetadataRecord& other)
      { return other.owner == candidate.owner && other.id == candidate.id; });
    if (candidate.owner == "LASF_Spec" && candidate.id == lasExtraBytesRecord)
    {
      descriptors.push_back({ candidate.payload.data(), candidate.payload.size() });
    }
    else if (candidate.owner != lasKeptOwner && !taken &&
      !(needs.copc && isForeignToCOPC(candidate)))
    {
      all.push_back(candidate);
    }
  }
  const std::string& wkt = needs.description.crsWkt;
  if (!wkt.empty() && needs.record("LASF_Projection", lasWktRecord) == nullptr)
  {
    const auto* text = reinterpret_cast<const std::byte*>(wkt.c_str());
    all.push_back(record("LASF_Projection", lasWktRecord, "OGC coordinate system WKT",
      { text, text + wkt.size() + 1 }));
  }
  if (!extra.empty())
  {
    all.push_back(record(
      "LASF_Spec", lasExtraBytesRecord, "Extra bytes", composeExtraBytes(extra, descriptors)));
  }
  for (MetadataRecord& kept : all)
  {
    const bool large = kept.payload.size() > mostRecordPayload;
    (large ? plan.extendedRecords : plan.records).push_back(std::move(kept));
  }
}

bool contains(const std::vector<MetadataRecord>& records, std::uint16_t projectionRecord)
{
  return std::any_of(records.begin(), records.end(),
    [&](const MetadataRecord& r)
    { return r.owner == "LASF_Projection" && r.id == projectionRecord; });
}

/// The lowest version that can say all of it; the encoding bits that still hold.
void chooseVersion(const Needs& needs, bool extra, LASExport& plan)
{
  const bool wkt =
    contains(plan.records, lasWktRecord) || contains(plan.extendedRecords, lasWktRecord);
  const bool onlyWkt = wkt && !contains(plan.records, geoKeysRecord);
  const bool many = needs.description.pointCount > std::numeric_limits<std::uint32_t>::max();
  const int format = plan.layout.pointFormat;
  const bool latest = format >= 6 || extra || onlyWkt || many || !plan.extendedRecords.empty();
  plan.versionMinor = latest ? 4 : (format >= 4 ? 3 : 2);
  constexpr std::uint16_t externalWaveforms = 4;
  constexpr std::uint16_t syntheticReturns = 8;
  const MetadataRecord* kept = needs.record(lasKeptOwner, lasKeptEncodingRecord);
  if (kept != nullptr && kept->payload.size() == sizeof(std::uint16_t))
  {
    plan.globalEncoding =
      static_cast<std::uint16_t>(loadNumber<std::uint16_t>(kept->payload.data()) &
        (lasGpsStandardTime | externalWaveforms | syntheticReturns));
  }
  plan.lostGeoKeys =
    needs.copc && !wkt && needs.record("LASF_Projection", geoKeysRecord) != nullptr;
  if (needs.copc)
  {
    plan.globalEncoding &= static_cast<std::uint16_t>(~externalWaveforms);
  }
  if ((wkt && latest) || needs.copc)
  {
    plan.globalEncoding |= lasWktBit;
  }
}

double world(const QuantisationGrid& grid, const GridPosition& position, int axis)
{
  return grid.toWorld(position)[axis];
}

void storeCounts(const LASTotals& totals, const LASExport& plan, std::byte* to)
{
  const bool legacy =
    plan.layout.pointFormat < 6 && totals.points <= std::numeric_limits<std::uint32_t>::max();
  if (legacy)
  {
    storeNumber(to + 107, static_cast<std::uint32_t>(totals.points));
    for (std::size_t i = 0; i < 5; ++i)
    {
      storeNumber(to + 111 + 4 * i, static_cast<std::uint32_t>(totals.byReturn[i]));
    }
  }
  if (plan.versionMinor >= 4)
  {
    storeNumber(to + 247, totals.points);
    for (std::size_t i = 0; i < totals.byReturn.size(); ++i)
    {
      storeNumber(to + 255 + 8 * i, totals.byReturn[i]);
    }
  }
}
} // namespace

LASDate LASDate::today()
{
  std::time_t now = std::time(nullptr);
  if (const char* const fixed = std::getenv("SOURCE_DATE_EPOCH"))
  {
    now = static_cast<std::time_t>(std::strtoll(fixed, nullptr, 10));
  }
  std::tm day = {};
  if (::gmtime_r(&now, &day) == nullptr)
  {
    return {};
  }
  return { static_cast<std::uint16_t>(day.tm_yday + 1),
    static_cast<std::uint16_t>(day.tm_year + 1900) };
}

std::vector<std::string> LASExport::findings(const LASTotals& totals) const
{
  std::vector<std::string> all = changes;
  const std::vector<std::string> ofFields = fieldFindings(*this, totals);
  all.insert(all.end(), ofFields.begin(), ofFields.end());
  return all;
}

std::size_t LASExport::headerBytes() const
{
  return versionMinor >= 4 ? lasHeaderBytes14
                           : (versionMinor == 3 ? lasHeaderBytes13 : lasHeaderBytes12);
}

Result<LASExport> LASExport::plan(
  const SinkDescription& description, const std::string& path, Formats formats)
{
  if (gpsTimesOf(description.schema, description.metadata) == GpsTimes::Mixed)
  {
    return makeError(Error::Kind::BadArgument,
      path +
        ": the points have GPS times of two kinds, seconds of a week and standard GPS times, and a "
        "LAS file has one; build a store without gps_time, or export the points of each input "
        "alone");
  }
  const Needs needs{ description, formats == Formats::OfCOPC };
  LASExport plan;
  if (auto done = placeGrid(description, path, plan); !done)
  {
    return done.error();
  }
  const std::vector<Attribute> extra = chooseLASFields(description, pointFormatFor(needs), plan);
  if (plan.layout.pointBytes > std::numeric_limits<std::uint16_t>::max())
  {
    return makeError(Error::Kind::BadArgument,
      path + ": a point of " + std::to_string(plan.layout.pointBytes) +
        " bytes is longer than LAS allows, 65535; leave out some attributes");
  }
  collectRecords(needs, extra, plan);
  chooseVersion(needs, !extra.empty(), plan);
  return plan;
}

std::vector<std::byte> LASExport::header(const LASTotals& totals, std::uint32_t recordCount,
  std::uint32_t pointOffset, std::uint64_t extendedOffset, bool compressed) const
{
  std::vector<std::byte> bytes(headerBytes());
  std::byte* to = bytes.data();
  std::memcpy(to, "LASF", 4);
  storeNumber(to + 6, globalEncoding);
  storeNumber<std::uint8_t>(to + 24, 1);
  storeNumber(to + 25, static_cast<std::uint8_t>(versionMinor));
  storeText(to + 26, 32, "EXPORT");
  storeText(to + 58, 32, "PointFront");
  storeNumber(to + 90, created.dayOfYear);
  storeNumber(to + 92, created.year);
  storeNumber(to + 94, static_cast<std::uint16_t>(headerBytes()));
  storeNumber(to + 96, pointOffset);
  storeNumber(to + 100, recordCount);
  storeNumber(to + 104, static_cast<std::uint8_t>(layout.pointFormat | (compressed ? 0x80 : 0)));
  storeNumber(to + 105, static_cast<std::uint16_t>(layout.pointBytes));
  for (int axis = 0; axis < 3; ++axis)
  {
    const auto a = static_cast<std::size_t>(axis);
    storeNumber(to + 131 + 8 * a, grid.scale[axis]);
    storeNumber(to + 155 + 8 * a, grid.offset[axis]);
    const bool any = totals.points > 0;
    storeNumber(to + 179 + 16 * a, any ? world(grid, totals.high, axis) : 0.0);
    storeNumber(to + 187 + 16 * a, any ? world(grid, totals.low, axis) : 0.0);
  }
  storeCounts(totals, *this, to);
  if (versionMinor >= 4)
  {
    storeNumber(to + 235, extendedOffset);
    storeNumber(to + 243, static_cast<std::uint32_t>(extendedRecords.size()));
  }
  return bytes;
}

std::vector<std::byte> LASExport::beginning(const std::vector<MetadataRecord>& all) const
{
  std::vector<std::byte> bytes(headerBytes());
  for (const MetadataRecord& record : all)
  {
    const std::vector<std::byte> text = composeLASRecord(record, false);
    bytes.insert(bytes.end(), text.begin(), text.end());
  }
  return bytes;
}

std::vector<std::byte> composeLASRecord(const MetadataRecord& record, bool extended)
{
  const std::size_t head = extended ? lasExtendedRecordHeaderBytes : lasRecordHeaderBytes;
  std::vector<std::byte> bytes(head + record.payload.size());
  storeText(bytes.data() + 2, 16, record.owner);
  storeNumber(bytes.data() + 18, record.id);
  if (extended)
  {
    storeNumber(bytes.data() + 20, static_cast<std::uint64_t>(record.payload.size()));
  }
  else
  {
    storeNumber(bytes.data() + 20, static_cast<std::uint16_t>(record.payload.size()));
  }
  storeText(bytes.data() + head - 32, 32, record.description);
  std::copy(record.payload.begin(), record.payload.end(),
    bytes.begin() + static_cast<std::ptrdiff_t>(head));
  return bytes;
}

} // namespace pointfront
