#include "FileBytes.h"
#include "LASWriter.h"
#include "RealFiles.h"
#include "SourcePoints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace pointfront::test
{
namespace
{
namespace fs = std::filesystem;

SinkDescription sinkFor(const PointSource& source)
{
  const SourceDescription& description = source.description();
  SinkDescription sink;
  sink.schema = description.schema;
  sink.grid = *description.grid;
  sink.pointCount = description.pointCount;
  sink.crsWkt = description.crsWkt;
  sink.metadata = description.metadata;
  return sink;
}

Result<void> copyTo(PointSink& sink, const PointSource& source, const SinkDescription& description)
{
  if (auto done = sink.begin(description); !done)
  {
    return done;
  }
  PointBatch batch;
  for (std::uint64_t chunk = 0; chunk < source.chunkCount(); ++chunk)
  {
    if (auto done = source.read(chunk, batch); !done)
    {
      return done;
    }
    if (auto done = sink.append(batch); !done)
    {
      return done;
    }
  }
  return sink.finish();
}

bool isCrs(const MetadataRecord& record)
{
  return record.owner == "LASF_Projection" || record.owner == "PointFront";
}

std::vector<std::vector<std::byte>> crsPayloads(const SourceDescription& description)
{
  std::vector<std::vector<std::byte>> payloads;
  for (const MetadataRecord& record : description.metadata)
  {
    if (isCrs(record))
    {
      payloads.push_back(record.payload);
    }
  }
  return payloads;
}

void expectSamePoints(const PointSource& a, const PointSource& b)
{
  EXPECT_EQ(*a.description().grid, *b.description().grid);
  ASSERT_EQ(a.description().schema, b.description().schema);
  const PointBatch first = readAll(a);
  const PointBatch second = readAll(b);
  ASSERT_EQ(first.size(), second.size());
  EXPECT_TRUE(first.positions == second.positions);
  for (std::size_t c = 0; c < first.columns.size(); ++c)
  {
    EXPECT_TRUE(first.columns[c] == second.columns[c]) << a.description().schema[c].name;
  }
}

struct RoundTrip
{
  RealFile file;
  LASWriter::Encoding encoding;
};

void PrintTo(const RoundTrip& trip, std::ostream* out)
{
  PrintTo(trip.file, out);
}

/// Files of more points than this would only take longer.
constexpr std::uint64_t mostPoints = 120000;

std::vector<RoundTrip> roundTrips()
{
  std::vector<RoundTrip> trips;
  for (const std::vector<RealFile>* list : { &realLASFiles, &realLAZFiles })
  {
    for (const RealFile& file : *list)
    {
      if (file.points <= mostPoints)
      {
        trips.push_back({ file, LASWriter::Encoding::Las });
        trips.push_back({ file, LASWriter::Encoding::Laz });
      }
    }
  }
  return trips;
}

std::string tripName(const testing::TestParamInfo<RoundTrip>& trip)
{
  std::string name = trip.param.file.path;
  name += trip.param.encoding == LASWriter::Encoding::Las ? "_to_las" : "_to_laz";
  std::replace_if(
    name.begin(), name.end(), [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
  return name;
}

class LASRoundTrip : public testing::TestWithParam<RoundTrip>
{
};

TEST_P(LASRoundTrip, GivesBackEveryIntegerAndTheCrs)
{
  const RoundTrip& trip = GetParam();
  const auto source = openOrFail(sharedData(trip.file.path));
  ASSERT_TRUE(source);
  const std::string path =
    outputFolder() + "/" + tripName(testing::TestParamInfo<RoundTrip>(trip, 0)) + ".las";
  LASWriter writer(path, trip.encoding);
  const Result<void> done = copyTo(writer, *source, sinkFor(*source));
  ASSERT_TRUE(done) << done.error().what;
  const auto copy = openOrFail(path);
  ASSERT_TRUE(copy);
  expectSamePoints(*source, *copy);
  EXPECT_EQ(copy->description().crsWkt, source->description().crsWkt);
  EXPECT_EQ(copy->description().warnings, std::vector<std::string>());
  EXPECT_EQ(crsPayloads(copy->description()).size(), crsPayloads(source->description()).size());
  fs::remove(path);
}

INSTANTIATE_TEST_SUITE_P(AllFiles, LASRoundTrip, testing::ValuesIn(roundTrips()), tripName);
} // namespace
} // namespace pointfront::test
