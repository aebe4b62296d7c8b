#include "pointfront/Points/GpsTimes.h"

#include <algorithm>
#include <cstddef>

namespace pointfront
{
namespace
{
std::vector<MetadataRecord>::const_iterator keptRecord(
  const std::vector<MetadataRecord>& metadata, std::uint16_t id)
{
  return std::find_if(metadata.begin(), metadata.end(),
    [id](const MetadataRecord& record) { return record.owner == lasKeptOwner && record.id == id; });
}

void removeKept(std::vector<MetadataRecord>& metadata, std::uint16_t id)
{
  metadata.erase(std::remove_if(metadata.begin(), metadata.end(),
                   [id](const MetadataRecord& record)
                   { return record.owner == lasKeptOwner && record.id == id; }),
    metadata.end());
}
} // namespace

GpsTimes gpsTimesOf(const AttributeSchema& schema, const std::vector<MetadataRecord>& metadata)
{
  const auto encoding = keptRecord(metadata, lasKeptEncodingRecord);
  const auto isTime = [](const Attribute& attribute) { return attribute.name == "gps_time"; };
  if (std::none_of(schema.begin(), schema.end(), isTime))
  {
    return GpsTimes::Unknown;
  }
  if (keptRecord(metadata, lasMixedTimesRecord) != metadata.end())
  {
    return GpsTimes::Mixed;
  }
  if (encoding == metadata.end() || encoding->payload.size() != sizeof(std::uint16_t))
  {
    return GpsTimes::Unknown;
  }
  const unsigned bits = std::to_integer<unsigned>(encoding->payload[0]); // little endian
  return (bits & lasGpsStandardTime) != 0 ? GpsTimes::Standard : GpsTimes::Week;
}

void GatheredTimes::add(const std::string& path, const AttributeSchema& schema,
  const std::vector<MetadataRecord>& metadata)
{
  const GpsTimes own = gpsTimesOf(schema, metadata);
  if (own == GpsTimes::Unknown)
  {
    return;
  }
  if (times_ == GpsTimes::Unknown)
  {
    times_ = own;
    const auto encoding = keptRecord(metadata, lasKeptEncodingRecord);
    encoding_ = encoding == metadata.end() ? MetadataRecord() : *encoding;
  }
  times_ = times_ == own ? own : GpsTimes::Mixed;
  std::string* const first = own == GpsTimes::Week ? &week_
    : own == GpsTimes::Standard                    ? &standard_
                                                   : nullptr;
  if (first != nullptr && first->empty())
  {
    *first = path;
  }
}

std::string GatheredTimes::warning() const
{
  return week_.empty() || standard_.empty()
    ? std::string()
    : "The GPS times of '" + week_ + "' are seconds of a week, and those of '" + standard_ +
      "' are standard GPS times: gps_time holds both kinds, and cannot be written into one LAS "
      "file.";
}

void GatheredTimes::keepIn(std::vector<MetadataRecord>& metadata) const
{
  removeKept(metadata, lasMixedTimesRecord);
  if (times_ == GpsTimes::Unknown)
  {
    return;
  }
  const auto known = keptRecord(metadata, lasKeptEncodingRecord);
  if (!encoding_.payload.empty() &&
    (known == metadata.end() || known->payload != encoding_.payload))
  {
    removeKept(metadata, lasKeptEncodingRecord);
    metadata.push_back(encoding_);
  }
  if (times_ == GpsTimes::Mixed)
  {
    metadata.push_back({ lasKeptOwner, lasMixedTimesRecord, "GPS times of both kinds", {} });
  }
}

} // namespace pointfront
