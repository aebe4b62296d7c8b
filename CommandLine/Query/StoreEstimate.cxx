#include "StoreEstimate.h"

#include "ByteSize.h"

#include "pointfront/Disk/DiskEstimate.h"
#include "pointfront/Quality/QualityCurve.h"
#include "pointfront/Records/RecordLayout.h"

#include <nlohmann/json.hpp>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <optional>

namespace pointfront
{
namespace
{

/// Least and most.
using Range = std::array<double, 2>;

/// Points that two cores store in a second, from the section "What it costs" of docs/tradeoffs.md.
constexpr Range lasPointsASecond{ 5.4e6, 7.6e6 };
constexpr Range lazPointsASecond{ 1.8e6, 2.6e6 };
/// Starting, and what does not depend on the number of points.
constexpr double startSeconds = 0.1;
/// From "Time to the first picture" there: milliseconds and bytes of stores of 1 to 200 million
/// points, drawn by the software back end, and from the same table of another day.
constexpr Range firstPictureMs{ 12.0, 35.0 };
constexpr double firstPictureBytes = 0.2e6;
/// A build holds the tool, and the records with what sorts them.
constexpr double toolBytes = 32e6;
constexpr double mostRecords = 6.0;
/// The complete picture that is told of.
constexpr const char* pictureTechnique = "blended";
constexpr double pictureErrorPx = 1.0;

struct Estimate
{
  Range storeBytes;
  std::optional<Range> buildSeconds;
  Range buildMemory;
  CurvePlace picture;
  Range pictureBytes;
};

std::optional<Range> rateOf(const std::string& format)
{
  const auto begins = [&format](const char* word) { return format.rfind(word, 0) == 0; };
  return begins("LAZ") ? std::optional<Range>(lazPointsASecond)
    : begins("LAS")    ? std::optional<Range>(lasPointsASecond)
                       : std::nullopt;
}

double machineBytes()
{
  return double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
}

Estimate estimateOf(const SourceInfo& info)
{
  const std::uint64_t points = info.points();
  const std::size_t recordBytes = RecordLayout(info.description.schema).bytes();
  DiskEstimate disk;
  estimateStore(disk, points, recordBytes);
  Estimate estimate{};
  estimate.storeBytes = { double(disk.storeBytes), double(disk.likelyStoreBytes) };
  if (const auto rate = rateOf(info.description.format))
  {
    estimate.buildSeconds =
      Range{ double(points) / (*rate)[1], startSeconds + double(points) / (*rate)[0] };
  }
  const double records = double(points) * double(recordBytes);
  const double most = toolBytes + std::min(0.5 * machineBytes(), mostRecords * records);
  estimate.buildMemory = { std::min(most, toolBytes + records), most };
  estimate.picture = expectedDifference(pictureTechnique, pictureErrorPx).value();
  const CurveRange& read = estimate.picture.megabytes;
  estimate.pictureBytes = { std::min(1e6 * read.least, estimate.storeBytes[0]),
    std::min(1e6 * read.most, estimate.storeBytes[1]) };
  return estimate;
}

std::string bytesText(const Range& range)
{
  return byteSizeText(static_cast<std::uint64_t>(range[0])) + " to " +
    byteSizeText(static_cast<std::uint64_t>(range[1]));
}

std::string numbersText(const char* format, const Range& range)
{
  std::array<char, 80> text{};
  std::snprintf(text.data(), text.size(), format, range[0], range[1]);
  return text.data();
}

nlohmann::ordered_json whole(const Range& range)
{
  return { static_cast<std::uint64_t>(range[0]), static_cast<std::uint64_t>(range[1]) };
}

} // namespace

nlohmann::ordered_json estimateJson(const SourceInfo& info)
{
  const Estimate estimate = estimateOf(info);
  const CurvePlace& picture = estimate.picture;
  nlohmann::ordered_json object;
  object["store_bytes"] = whole(estimate.storeBytes);
  object["build_seconds"] = estimate.buildSeconds ? nlohmann::ordered_json(*estimate.buildSeconds)
                                                  : nlohmann::ordered_json();
  object["build_memory_bytes"] = whole(estimate.buildMemory);
  object["first_picture"] = { { "milliseconds", firstPictureMs },
    { "bytes_read", whole({ 0.0, std::min(firstPictureBytes, estimate.storeBytes[1]) }) } };
  object["complete_picture"] = { { "technique", picture.technique },
    { "error_px", picture.errorPx },
    { "milliseconds", { picture.completeMs.least, picture.completeMs.most } },
    { "bytes_read", whole(estimate.pictureBytes) },
    { "memory_bytes",
      whole({ 1048576.0 * picture.peakMiB.least, 1048576.0 * picture.peakMiB.most }) } };
  object["source"] = curveSource();
  return object;
}

std::string estimateText(const SourceInfo& info)
{
  const Estimate estimate = estimateOf(info);
  const CurvePlace& picture = estimate.picture;
  const Range completeMs{ picture.completeMs.least, picture.completeMs.most };
  return "\n  a store     " + bytesText(estimate.storeBytes) +
    (estimate.buildSeconds ? numbersText(", built in %.2g to %.2g s", *estimate.buildSeconds)
                           : "") +
    " with " + bytesText(estimate.buildMemory) + " of memory\n  a picture   first " +
    numbersText("%.0f to %.0f ms", firstPictureMs) + ", complete " +
    numbersText("%.0f to %.0f ms", completeMs) + " and " + bytesText(estimate.pictureBytes) +
    " read (" + picture.technique + " at 1 px)\n              estimated from " + curveSource();
}

} // namespace pointfront
