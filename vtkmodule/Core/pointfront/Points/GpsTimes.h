#pragma once

#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Points/PointSource.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

/// The seconds that the attribute `gps_time` counts.
enum class GpsTimes
{
  Unknown, ///< there is none, or nobody says
  Week, ///< seconds of a GPS week
  Standard, ///< GPS seconds less 10^9
  Mixed ///< some points have one kind and some the other
};

/// Owner of the records that keep what a LAS header says from a source to an export.
constexpr const char* lasKeptOwner = "PointFront";
/// The header's global encoding, 2 bytes; bit 0 says that times are standard ones.
constexpr std::uint16_t lasKeptEncodingRecord = 1;
/// No bytes: times are mixed.
constexpr std::uint16_t lasMixedTimesRecord = 2;
constexpr std::uint16_t lasGpsStandardTime = 1; ///< that bit

GpsTimes gpsTimesOf(const AttributeSchema& schema, const std::vector<MetadataRecord>& metadata);

/// Collects the times of clouds that become one, and the records that say so of all.
class GatheredTimes
{
public:
  void add(const std::string& path, const AttributeSchema& schema,
    const std::vector<MetadataRecord>& metadata);
  GpsTimes times() const { return times_; }
  /// Where the added ones differ from each other: a sentence about it; else "".
  std::string warning() const;
  /// Makes the records say what times() are, where they are known; else no record says that they
  /// are mixed.
  void keepIn(std::vector<MetadataRecord>& metadata) const;

private:
  GpsTimes times_ = GpsTimes::Unknown;
  MetadataRecord encoding_; ///< as the first that is known has it
  std::string week_; ///< paths of the first of each kind
  std::string standard_;
};

} // namespace pointfront
