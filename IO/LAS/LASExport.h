#pragma once

#include "LASPointLayout.h"

#include "pointfront/Base/Result.h"
#include "pointfront/Points/PointSink.h"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// The totals in the header of a LAS file being written; counted as the points come.
struct LASTotals
{
  std::uint64_t points = 0;
  std::array<std::uint64_t, 15> byReturn{}; ///< return numbers 1 to 15
  GridPosition low{ 0 }; ///< valid if there are points
  GridPosition high{ 0 };
  /// By column of the layout, empty if there are none: values that their field does not hold.
  std::vector<std::uint64_t> replaced;
  std::uint64_t roundedAngles = 0; ///< scan angles between the steps that the format has
};

/// A day as LAS headers have it.
struct LASDate
{
  std::uint16_t dayOfYear = 0; ///< from 1; 0: not known
  std::uint16_t year = 0;

  /// In UTC; that of SOURCE_DATE_EPOCH (seconds since 1970) where the environment has it, so that
  /// files can be made again byte by byte.
  static LASDate today();
};

/// How points of a schema become a LAS file: decided before the first point.
/// Which format and version: see LASWriter.
struct LASExport
{
  /// Where a field of the record comes from. A field without one is 0.
  struct Origin
  {
    std::size_t column = 0;
    std::size_t byte = 0; ///< offset in the column's element, for one component taken alone
    ScalarType type = ScalarType::UInt8;
    /// Values may be beyond the field, which has `instead` there.
    bool partly = false;
    std::uint8_t instead = 0;
  };

  /// Which point formats may be chosen.
  enum class Formats
  {
    Smallest, ///< that holds all attributes, of any version
    OfCOPC ///< 6, 7 or 8 in LAS 1.4, reference systems as WKT
  };

  int versionMinor = 2;
  LASPointLayout layout;
  std::vector<std::optional<Origin>> origins; ///< one for each column of `layout`
  QuantisationGrid grid; ///< every coordinate fits into 32 bits
  std::uint16_t globalEncoding = 0;
  LASDate created;
  std::vector<MetadataRecord> records; ///< written before the points
  std::vector<MetadataRecord> extendedRecords; ///< payloads above 65,535 bytes, behind them

  /// One for each column of `layout`: the extra bytes that have what the field lacks; mostly "".
  std::vector<std::string> exactNames;
  /// OfCOPC: the reference system was known by GeoTIFF keys only, which are left out.
  bool lostGeoKeys = false;
  /// Axes with a coarser step than transformed coordinates had before, and extra bytes with another
  /// name than their attribute: a sentence for each.
  std::vector<std::string> changes;

  /// Steps and attributes that are not as they were: full sentences.
  std::vector<std::string> findings(const LASTotals& totals) const;
  std::size_t headerBytes() const;
  /// Room for the header, and `all` behind it as they stand in a file.
  std::vector<std::byte> beginning(const std::vector<MetadataRecord>& all) const;
  /// Errors   BadArgument with `path`: coordinates or attributes that no LAS record can hold; GPS
  /// times
  ///          of two kinds.
  static Result<LASExport> plan(const SinkDescription& description, const std::string& path,
    Formats formats = Formats::Smallest);
  /// The public header block. `points` begin at `pointOffset`; `extendedOffset` is where the
  /// extended records begin, 0 if there are none.
  std::vector<std::byte> header(const LASTotals& totals, std::uint32_t recordCount,
    std::uint32_t pointOffset, std::uint64_t extendedOffset, bool compressed) const;
};

/// A variable length record as it stands in a file; extended: with a header of 60 bytes.
std::vector<std::byte> composeLASRecord(const MetadataRecord& record, bool extended);

} // namespace pointfront
