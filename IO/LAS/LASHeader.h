#pragma once

#include "LASBytes.h"

#include "pointfront/Base/Bounds.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Points/QuantisationGrid.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

/// Sizes of the public header block.
constexpr std::size_t lasHeaderBytes12 = 227; ///< LAS 1.0 to 1.2
constexpr std::size_t lasHeaderBytes13 = 235; ///< LAS 1.3
constexpr std::size_t lasHeaderBytes14 = 375; ///< LAS 1.4

/// Bits of the global encoding field.
constexpr std::uint16_t lasWktBit = 16;

/// The public header block of a LAS or LAZ file, checked: what it says of sizes and offsets is
/// possible for this file, the grid is usable. Counts are still claims.
/// Source   ASPRS LAS 1.4 R15, section 2.4; LAS 1.0 to 1.3.
struct LASHeader
{
  int versionMinor = 0; ///< 0 to 4; the major version is 1
  std::uint16_t globalEncoding = 0;
  std::uint16_t headerBytes = 0;
  std::uint32_t pointOffset = 0; ///< byte offset of the first point, inside the file or at its end
  std::uint32_t recordCount = 0; ///< VLRs, as claimed
  std::uint8_t pointFormat = 0; ///< 0 to 10
  bool compressed = false; ///< LAZ
  std::uint16_t pointBytes = 0; ///< size of one point record, at least the format's minimum
  std::uint64_t pointCount = 0; ///< as claimed
  QuantisationGrid grid;
  Bounds bounds; ///< as claimed; empty when it is no box
  std::uint64_t extendedRecordOffset = 0;
  std::uint32_t extendedRecordCount = 0; ///< EVLRs, as claimed

  std::string versionText() const { return "1." + std::to_string(versionMinor); }
};

/// True if integers of 32 bit survive the way to double world coordinates and back on an axis of
/// that scale and offset.
bool exactInDouble(double scale, double offset);

/// Reads the header at the beginning of `file`.
/// Errors   BadFormat, Truncated, Unsupported, each with `path` and the byte offset of the field.
/// What is wrong but harmless is added to `warnings`.
Result<LASHeader> parseLASHeader(
  ByteSpan file, const std::string& path, std::vector<std::string>& warnings);

} // namespace pointfront
