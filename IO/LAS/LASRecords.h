#pragma once

#include "LASBytes.h"
#include "LASHeader.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

/// Bytes of the header of a variable length record, and of an extended one.
constexpr std::size_t lasRecordHeaderBytes = 54;
constexpr std::size_t lasExtendedRecordHeaderBytes = 60;

/// Record ids of owner "LASF_Spec" and "LASF_Projection".
constexpr std::uint16_t lasExtraBytesRecord = 4;
constexpr std::uint16_t lasWktRecord = 2112;

/// A variable length record (VLR), or an extended one (EVLR) that lies behind the points.
struct LASRecord
{
  std::string owner; ///< user id
  std::uint16_t id = 0;
  std::string description;
  ByteSpan payload; ///< in the file's map

  bool is(const char* user, std::uint16_t record) const { return owner == user && id == record; }
};

/// All VLRs, then all EVLRs, in the order of the file, as far as they are sound: reading stops at
/// the first that does not fit, with a warning that counts the records lost. Never allocates by a
/// count that the file claims.
std::vector<LASRecord> readLASRecords(
  ByteSpan file, const LASHeader& header, std::vector<std::string>& warnings);

} // namespace pointfront
