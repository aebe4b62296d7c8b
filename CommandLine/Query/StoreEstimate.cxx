#include "StoreEstimate.h"

#include "ByteSize.h"

#include "pointfront/Quality/QualityCurve.h"

#include <nlohmann/json.hpp>

#include <unistd.h>

#include <algorithm>
#include <cstdio>

namespace pointfront
{
namespace
{

using Range = StoreEstimate::Range;

/// Points that two cores store in a second, from the section "What it costs" of docs/tradeoffs.md.
constexpr Range lasPointsASecond{ 5.4e6, 7.6e6 };
constexpr Range lazPointsASecond{ 1.8e6, 2.6e6 };
/// Starting, and what does not depend on the number of points.
constexpr Range startSeconds{ 0.02, 0.2 };
/// From "Time to the first picture" there: milliseconds and bytes of stores of 1 to 200 million
/// points, drawn by the software back end, and from the same table of another day.
constexpr Range firstPictureMs{ 12.0, 35.0 };
constexpr double firstPictureBytes = 0.2e6;
/// Attributes that vary are packed to this share of their bytes: surveys to a fifth to a half,
/// colours and normals beside floating-point coordinates to two thirds.
constexpr Range storedShare{ 1.0 / 6.0, 0.75 };
/// A store of a single point, and what each attribute adds to it.
constexpr Range smallestStore{ 4e3, 8e3 };
constexpr double attributeBytes = 256.0;
/// A build holds the tool, and the records with what sorts them.
constexpr Range toolBytes{ 15e6, 36e6 };
constexpr double mostRecords = 6.0;
/// The complete picture that is told of. The scenes of its curve have more points than this; a
/// cloud of few may cover some pixels only, which take no memory but the tool's.
constexpr const char* pictureTechnique = "blended";
constexpr double pictureErrorPx = 1.0;
constexpr double fewPoints = 1e5;
constexpr double emptyPictureBytes = 20e6;

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

/// Bytes that a complete picture of a store reads: at least its points' places and one attribute.
Range pictureBytes(const CurvePlace& picture, const Range& records, const Range& store)
{
  return { std::min(1e6 * picture.megabytes.least, 0.5 * storedShare[0] * records[0]),
    std::min(1e6 * picture.megabytes.most, store[1]) };
}

Range pictureMemory(const CurvePlace& picture, double points)
{
  constexpr double mebibyte = 1048576.0;
  return { points < fewPoints ? emptyPictureBytes : mebibyte * picture.peakMiB.least,
    mebibyte * picture.peakMiB.most };
}

} // namespace

void StoreEstimate::add(const EstimatedInput& input)
{
  ++inputs_;
  points_ += input.points;
  attributes_ = std::max(attributes_, input.attributes);
  for (std::size_t i = 0; i < recordBytes_.size(); ++i)
  {
    recordBytes_[i] += input.points * input.recordBytes[i];
  }
  const auto rate = rateOf(input.format);
  if (!rate)
  {
    readSeconds_.reset();
  }
  if (readSeconds_)
  {
    (*readSeconds_)[0] += input.points / (*rate)[1];
    (*readSeconds_)[1] += input.points / (*rate)[0];
  }
}

Range StoreEstimate::storeBytes() const
{
  return { smallestStore[0] + storedShare[0] * recordBytes_[0],
    smallestStore[1] + attributeBytes * double(attributes_) + storedShare[1] * recordBytes_[1] };
}

std::optional<Range> StoreEstimate::buildSeconds() const
{
  return readSeconds_ ? std::optional<Range>(Range{ startSeconds[0] + (*readSeconds_)[0],
                          startSeconds[1] + (*readSeconds_)[1] })
                      : std::nullopt;
}

Range StoreEstimate::buildMemory() const
{
  const double allowed = 0.5 * machineBytes(); // without --memory; what is more goes to the disk
  const double most = mostRecords * recordBytes_[1];
  return { toolBytes[0] + (most > allowed ? 0.0 : recordBytes_[0]),
    toolBytes[1] + std::min(allowed, most) };
}

nlohmann::ordered_json StoreEstimate::json() const
{
  const CurvePlace picture = expectedDifference(pictureTechnique, pictureErrorPx).value();
  const Range store = storeBytes();
  const std::optional<Range> seconds = buildSeconds();
  nlohmann::ordered_json object;
  object["store_bytes"] = whole(store);
  object["build_seconds"] = seconds ? nlohmann::ordered_json(*seconds) : nlohmann::ordered_json();
  object["build_memory_bytes"] = whole(buildMemory());
  object["first_picture"] = { { "milliseconds", firstPictureMs },
    { "bytes_read", whole({ 0.0, std::min(firstPictureBytes, store[1]) }) } };
  object["complete_picture"] = { { "technique", picture.technique },
    { "error_px", picture.errorPx },
    { "milliseconds", { picture.completeMs.least, picture.completeMs.most } },
    { "bytes_read", whole(pictureBytes(picture, recordBytes_, store)) },
    { "memory_bytes", whole(pictureMemory(picture, points_)) } };
  object["source"] = curveSource();
  return object;
}

std::string StoreEstimate::text() const
{
  const CurvePlace picture = expectedDifference(pictureTechnique, pictureErrorPx).value();
  const Range completeMs{ picture.completeMs.least, picture.completeMs.most };
  const std::optional<Range> seconds = buildSeconds();
  return "\n  a store     " + bytesText(storeBytes()) +
    (seconds ? numbersText(", built in %.2g to %.2g s", *seconds) : "") + " with " +
    bytesText(buildMemory()) + " of memory\n  a picture   first " +
    numbersText("%.0f to %.0f ms", firstPictureMs) + ", complete " +
    numbersText("%.0f to %.0f ms", completeMs) + " and " +
    bytesText(pictureBytes(picture, recordBytes_, storeBytes())) + " read (" + picture.technique +
    " at 1 px)\n              estimated from " + curveSource();
}

} // namespace pointfront
