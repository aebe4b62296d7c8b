#include "COPCWriter.h"
#include "FileBytes.h"
#include "FilesInTheMaking.h"
#include "LASExport.h"
#include "LASWriter.h"
#include "SourcePoints.h"

#include "pointfront/Points/GpsTimes.h"

#include <gtest/gtest.h>

#include <csignal>
#include <cstring>
#include <filesystem>
#include <limits>
#include <sys/resource.h>
#include <utility>

namespace pointfront::test
{
namespace
{
namespace fs = std::filesystem;

/// A description with these attributes on a grid of 0.01.
SinkDescription withAttributes(const std::vector<Attribute>& attributes)
{
  SinkDescription description;
  description.grid.scale = glm::dvec3(0.01);
  for (const Attribute& attribute : attributes)
  {
    description.schema.add(attribute);
  }
  return description;
}

std::string formatOf(const SinkDescription& description)
{
  const Result<LASExport> plan = LASExport::plan(description, "out.las");
  EXPECT_TRUE(plan) << plan.error().what;
  return plan ? "1." + std::to_string(plan->versionMinor) + " format " +
      std::to_string(plan->layout.pointFormat)
              : "";
}

const Attribute rgb{ "rgb", ScalarType::UInt16, 3 };
const Attribute gpsTime{ "gps_time", ScalarType::Float64 };
const Attribute nir{ "nir", ScalarType::UInt16 };
const Attribute classes{ "classification", ScalarType::UInt8 };
const Attribute wave{ "wave_descriptor", ScalarType::UInt8 };
const Attribute channel{ "scanner_channel", ScalarType::UInt8 };

TEST(LASExport, TakesTheSmallestFormatThatHoldsTheSchema)
{
  EXPECT_EQ(formatOf(withAttributes({})), "1.2 format 0");
  EXPECT_EQ(formatOf(withAttributes({ gpsTime })), "1.2 format 1");
  EXPECT_EQ(formatOf(withAttributes({ rgb })), "1.2 format 2");
  EXPECT_EQ(formatOf(withAttributes({ rgb, gpsTime })), "1.2 format 3");
  EXPECT_EQ(formatOf(withAttributes({ wave })), "1.3 format 4");
  EXPECT_EQ(formatOf(withAttributes({ wave, rgb })), "1.3 format 5");
  EXPECT_EQ(formatOf(withAttributes({ channel })), "1.4 format 6");
  EXPECT_EQ(formatOf(withAttributes({ channel, rgb })), "1.4 format 7");
  EXPECT_EQ(formatOf(withAttributes({ nir })), "1.4 format 8");
  EXPECT_EQ(formatOf(withAttributes({ channel, wave })), "1.4 format 9");
  EXPECT_EQ(formatOf(withAttributes({ nir, wave })), "1.4 format 10");
  EXPECT_EQ(formatOf(withAttributes({ { "height", ScalarType::Float32 } })), "1.4 format 0");
}

TEST(LASExport, TakesANewerFormatForLargerValues)
{
  SinkDescription description = withAttributes({ classes });
  description.largest = { 31 };
  EXPECT_EQ(formatOf(description), "1.2 format 0");
  description.largest = { 65 };
  EXPECT_EQ(formatOf(description), "1.4 format 6");
  description.largest = { 31 };
  description.pointCount = 1ull << 33;
  EXPECT_EQ(formatOf(description), "1.4 format 0");
}

TEST(LASExport, WritesACrsWithoutARecordOfItsOwnAsWkt)
{
  SinkDescription description = withAttributes({});
  description.crsWkt = "LOCAL_CS[\"site\"]";
  const Result<LASExport> plan = LASExport::plan(description, "out.las");
  ASSERT_TRUE(plan);
  EXPECT_EQ(plan->versionMinor, 4);
  EXPECT_EQ(plan->globalEncoding, 16);
  ASSERT_EQ(plan->records.size(), 1u);
  EXPECT_EQ(plan->records[0].id, 2112);
  EXPECT_EQ(plan->records[0].payload.size(), description.crsWkt.size() + 1);
}

/// Writes one batch and opens what came out; nullptr after an expected Error goes to `error`.
std::unique_ptr<PointSource> written(const SinkDescription& description, const PointBatch& batch,
  const std::string& name, Error* error = nullptr)
{
  const std::string path = outputFolder() + "/" + name;
  LASWriter writer(path);
  Result<void> done = writer.begin(description);
  done = done ? writer.append(batch) : done;
  done = done ? writer.finish() : done;
  if (!done)
  {
    EXPECT_NE(error, nullptr) << done.error().what;
    EXPECT_FALSE(fs::exists(path));
    if (error != nullptr)
    {
      *error = done.error();
    }
    return nullptr;
  }
  return openOrFail(path);
}

PointBatch onePoint(const SinkDescription& description, const glm::dvec3& position)
{
  PointBatch batch;
  batch.resize(1, description.schema);
  batch.positions[0] = position;
  return batch;
}

TEST(LASExport, WritesColourOf8BitAsItIs)
{
  const SinkDescription description = withAttributes({ { "rgb", ScalarType::UInt8, 3 } });
  PointBatch batch = onePoint(description, glm::dvec3(1.0));
  batch.columns[0] = { std::byte{ 0 }, std::byte{ 128 }, std::byte{ 255 } };
  const auto source = written(description, batch, "colour.las");
  ASSERT_TRUE(source);
  EXPECT_EQ(source->description().format, "LAS 1.2 format 2");
  const PointBatch back = readAll(*source);
  for (const auto& [component, value] : { std::pair{ 0, 0.0 }, { 1, 128.0 }, { 2, 255.0 } })
  {
    EXPECT_EQ(valuesOf(back, source->description().schema, "rgb", component)[0], value);
  }
}

TEST(LASExport, WritesOtherAttributesAsExtraBytes)
{
  const SinkDescription description = withAttributes({ { "intensity", ScalarType::Float32 },
    { "normal", ScalarType::Float32, 3 }, { "histogram", ScalarType::UInt16, 4 } });
  PointBatch batch = onePoint(description, glm::dvec3(2.0));
  const float intensity = 0.25f;
  const float normal[3] = { 0.0f, 0.6f, 0.8f };
  const std::uint16_t histogram[4] = { 1, 20, 300, 4000 };
  std::memcpy(batch.columns[0].data(), &intensity, sizeof intensity);
  std::memcpy(batch.columns[1].data(), normal, sizeof normal);
  std::memcpy(batch.columns[2].data(), histogram, sizeof histogram);
  const auto source = written(description, batch, "extra.las");
  ASSERT_TRUE(source);
  const AttributeSchema& schema = source->description().schema;
  const PointBatch back = readAll(*source);
  EXPECT_EQ(valuesOf(back, schema, "intensity")[0], 0); // the field itself was not given
  EXPECT_EQ(valuesOf(back, schema, "intensity_exact")[0], 0.25);
  EXPECT_EQ(valuesOf(back, schema, "normal", 1)[0], 0.6f);
  EXPECT_EQ(valuesOf(back, schema, "histogram[3]")[0], 4000);
}

TEST(LASExport, MovesTheOffsetByWholeStepsWhereIntegersWouldNotReach)
{
  SinkDescription description = withAttributes({});
  const glm::dvec3 far(5e8, 1.0, -6e8);
  description.bounds.add(far);
  const auto source = written(description, onePoint(description, far), "far.las");
  ASSERT_TRUE(source);
  EXPECT_EQ(description.grid.toGrid(readAll(*source).positions[0]), description.grid.toGrid(far));
  EXPECT_EQ(source->description().grid->scale, description.grid.scale);
}

TEST(LASExport, RefusesWhatNoRecordCanHold)
{
  struct Case
  {
    const char* words;
    Attribute attribute;
    unsigned value;
    glm::dvec3 position;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Case cases[] = {
    { "point 0 has classification 65", classes, 65, glm::dvec3(0.0) },
    { "point 0 has return_number 8", { "return_number", ScalarType::UInt8 }, 8, glm::dvec3(0.0) },
    { "point 0 has x = 500000000", classes, 1, glm::dvec3(5e8, 0.0, 0.0) },
    { "point 0 has z = nan", classes, 1, glm::dvec3(0.0, 0.0, nan) },
  };
  for (const Case& c : cases)
  {
    const SinkDescription description = withAttributes({ c.attribute });
    PointBatch batch = onePoint(description, c.position);
    batch.columns[0][0] = static_cast<std::byte>(c.value);
    Error error;
    EXPECT_EQ(written(description, batch, "refused.las", &error), nullptr);
    EXPECT_EQ(error.kind, Error::Kind::BadArgument);
    EXPECT_NE(error.what.find(c.words), std::string::npos) << error.what;
  }
  SinkDescription wide = withAttributes({});
  wide.bounds.add(glm::dvec3(0.0));
  wide.bounds.add(glm::dvec3(1e8, 0.0, 0.0));
  const Result<LASExport> plan = LASExport::plan(wide, "out.las");
  ASSERT_FALSE(plan);
  EXPECT_NE(plan.error().what.find("the extent in x is 100000000"), std::string::npos);
}

TEST(LASExport, TransformedCoordinatesGetTheFinestStepThatFits)
{
  SinkDescription wide = withAttributes({});
  wide.grid.scale = { 1e-9, 1e-9, 0.01 };
  wide.bounds.add(glm::dvec3(2.1, 48.0, 0.0));
  wide.bounds.add(glm::dvec3(8.58, 50.0, 90.0));
  wide.stepBefore = { 9e-8, 9e-8, 0.0 }; // a centimetre
  Result<LASExport> plan = LASExport::plan(wide, "out.las");
  ASSERT_TRUE(plan) << plan.error().what;
  EXPECT_EQ(plan->grid.scale, glm::dvec3(1e-8, 1e-9, 0.01));
  EXPECT_TRUE(plan->findings({}).empty());

  wide.stepBefore = { 9e-9, 9e-9, 0.0 }; // a millimetre: 1e-8 degrees are 1.1
  plan = LASExport::plan(wide, "out.las");
  ASSERT_TRUE(plan) << plan.error().what;
  EXPECT_EQ(plan->grid.scale.x, 1e-8);
  ASSERT_EQ(plan->findings({}).size(), 1u);
  EXPECT_NE(plan->findings({})[0].find("step of x is 1e-08"), std::string::npos)
    << plan->findings({})[0];

  wide.stepBefore = { 9e-10, 9e-10, 0.0 };
  plan = LASExport::plan(wide, "out.las");
  ASSERT_FALSE(plan);
  for (const char* const part : { "extent in x is 6.48", "1e-08", "9e-10", "--box", ".csv" })
  {
    EXPECT_NE(plan.error().what.find(part), std::string::npos) << plan.error().what;
  }

  wide.stepBefore = {}; // on its grid as it is: no step of it is given up
  plan = LASExport::plan(wide, "out.las");
  ASSERT_FALSE(plan);
  EXPECT_NE(plan.error().what.find("at a step of 1e-09"), std::string::npos) << plan.error().what;
}

TEST(LASExport, WithoutPointsIsAWholeFile)
{
  const SinkDescription description = withAttributes({ classes });
  PointBatch none;
  none.resize(0, description.schema);
  for (const auto encoding : { LASWriter::Encoding::Las, LASWriter::Encoding::Laz })
  {
    const std::string path = outputFolder() + "/none.las";
    LASWriter writer(path, encoding);
    ASSERT_TRUE(writer.begin(description));
    ASSERT_TRUE(writer.append(none));
    ASSERT_TRUE(writer.finish());
    const auto source = openOrFail(path);
    ASSERT_TRUE(source);
    EXPECT_EQ(source->description().pointCount, 0u);
    EXPECT_EQ(source->description().warnings, std::vector<std::string>());
  }
}

TEST(LASExport, LeavesNothingWhenItIsNotFinished)
{
  const SinkDescription description = withAttributes({ classes });
  for (const auto encoding : { LASWriter::Encoding::Las, LASWriter::Encoding::Laz })
  {
    const std::string path = outputFolder() + "/unfinished.las";
    {
      LASWriter writer(path, encoding);
      ASSERT_TRUE(writer.begin(description));
      ASSERT_TRUE(writer.append(onePoint(description, glm::dvec3(1.0))));
    }
    EXPECT_FALSE(fs::exists(path));
    EXPECT_TRUE(filesInTheMaking(path).empty());
  }
}

/// NumPy's default integers, and numbers of text, are wider than LAS's fields.
TEST(LASExport, TakesValuesOfAnyTypeThatTheFieldHolds)
{
  SinkDescription description = withAttributes({ { "classification", ScalarType::Int64 },
    { "intensity", ScalarType::Float32 }, { "gps_time", ScalarType::Float32 },
    { "scan_angle", ScalarType::Float64 }, { "rgb", ScalarType::UInt32, 3 } });
  description.largest = { 6, 0.9, 1e5, 20, 65535 };
  description.smallest = { 0, 0, 0, -20, 0 };
  PointBatch batch = onePoint(description, glm::dvec3(1.0));
  const std::int64_t label = 6;
  const float intensity = 0.5f;
  const float time = 1234.5f;
  const double angle = -7.0;
  const std::uint32_t colour[3] = { 1, 40000, 65535 };
  std::memcpy(batch.columns[0].data(), &label, sizeof label);
  std::memcpy(batch.columns[1].data(), &intensity, sizeof intensity);
  std::memcpy(batch.columns[2].data(), &time, sizeof time);
  std::memcpy(batch.columns[3].data(), &angle, sizeof angle);
  std::memcpy(batch.columns[4].data(), colour, sizeof colour);
  const Result<LASExport> plan = LASExport::plan(description, "out.las");
  ASSERT_TRUE(plan);
  ASSERT_EQ(plan->findings({}).size(), 1u);
  EXPECT_NE(plan->findings({})[0].find("'intensity'"), std::string::npos) << plan->findings({})[0];
  const auto source = written(description, batch, "any-type.las");
  ASSERT_TRUE(source);
  const AttributeSchema& schema = source->description().schema;
  const PointBatch read = readPoints(*source);
  const auto column = [&](const char* name) { return read.columns[*schema.find(name)].data(); };
  EXPECT_EQ(column("classification")[0], std::byte{ 6 });
  EXPECT_EQ(loadNumber<double>(column("gps_time")), 1234.5);
  EXPECT_EQ(loadNumber<float>(column("scan_angle")), -7.0f);
  EXPECT_EQ(loadNumber<std::uint16_t>(column("rgb") + 2), 40000);
  EXPECT_EQ(loadNumber<std::uint16_t>(column("rgb") + 4), 65535);
  EXPECT_EQ(loadNumber<float>(column("intensity_exact")), 0.5f);
}

TEST(LASExport, TakesTimesOf64BitIntegersThatDoublesHold)
{
  SinkDescription description = withAttributes({ { "gps_time", ScalarType::Int64 } });
  description.smallest = { 0 };
  for (const auto& [largest, findings] : { std::pair(1e15, 0u), std::pair(1e18, 1u) })
  {
    description.largest = { largest };
    EXPECT_EQ(LASExport::plan(description, "out.las")->findings({}).size(), findings) << largest;
  }
}

TEST(LASExport, SaysWhichFieldDoesNotHoldItsValues)
{
  SinkDescription description = withAttributes({ { "classification", ScalarType::UInt16 } });
  EXPECT_EQ(LASExport::plan(description, "out.las")->findings({}).size(), 1u) << "nobody knows";
  description.largest = { 300 };
  description.smallest = { 0 };
  EXPECT_EQ(LASExport::plan(description, "out.las")->findings({}).size(), 1u);
  description.largest = { 255 };
  EXPECT_TRUE(LASExport::plan(description, "out.las")->findings({}).empty());
  // Ranges that do not hold: an error, and no other class.
  PointBatch batch = onePoint(description, glm::dvec3(1.0));
  const std::uint16_t label = 300;
  std::memcpy(batch.columns[0].data(), &label, sizeof label);
  Error error;
  EXPECT_FALSE(written(description, batch, "wrong-range.las", &error));
  EXPECT_NE(error.what.find("classification"), std::string::npos) << error.what;
}

TEST(COPCWriter, NamesTheChoiceThatItsCallerHas)
{
  SinkDescription description = withAttributes({});
  description.metadata.push_back({ "LASF_Projection", 34735, "", std::vector<std::byte>(16) });
  const std::string path = outputFolder() + "/keys.copc.laz";
  for (const std::string name : { "AssumedCRS", "--assume-crs" })
  {
    COPCWriter::Options options;
    if (name != options.assumedCrsName)
    {
      options.assumedCrsName = name;
    }
    COPCWriter writer(path, options);
    ASSERT_TRUE(writer.begin(description));
    ASSERT_TRUE(writer.append(onePoint(description, glm::dvec3(1.0))));
    ASSERT_TRUE(writer.finish());
    ASSERT_EQ(writer.findings().size(), 1u);
    EXPECT_NE(
      writer.findings()[0].find("(a build with " + name + " gives it one)"), std::string::npos)
      << writer.findings()[0];
  }
}

TEST(LASExport, RefusesGpsTimesOfTwoKinds)
{
  SinkDescription description = withAttributes({ gpsTime });
  description.metadata.push_back(
    { lasKeptOwner, lasKeptEncodingRecord, "", { std::byte{ 1 }, std::byte{ 0 } } });
  EXPECT_EQ(LASExport::plan(description, "out.las")->globalEncoding, 1);
  description.metadata.push_back({ lasKeptOwner, lasMixedTimesRecord, "", {} });
  const Result<LASExport> mixed = LASExport::plan(description, "out.las");
  ASSERT_FALSE(mixed);
  EXPECT_NE(mixed.error().what.find("GPS times of two kinds"), std::string::npos)
    << mixed.error().what;
  description.schema = AttributeSchema();
  EXPECT_TRUE(LASExport::plan(description, "out.las")) << "without times";
}

/// Files of this process may not grow beyond some bytes: as good as a full disk.
class FileSizeLimit
{
public:
  explicit FileSizeLimit(rlim_t bytes)
  {
    ::getrlimit(RLIMIT_FSIZE, &before_);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{ bytes, before_.rlim_max };
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  ~FileSizeLimit()
  {
    ::setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

private:
  rlimit before_{};
  void (*handler_)(int) = nullptr;
};

TEST(LASExport, SaysWhenTheDiskIsFull)
{
  const SinkDescription description = withAttributes({ gpsTime });
  PointBatch batch;
  batch.resize(400000, description.schema);
  for (std::size_t i = 0; i < batch.size(); ++i)
  { // not compressible: every point far from the last
    batch.positions[i] = glm::dvec3(static_cast<double>((i * 2654435761u) % 20000000) * 0.01);
    const std::uint64_t noise = i * 0x9E3779B97F4A7C15ull;
    std::memcpy(&batch.columns[0][8 * i], &noise, sizeof noise);
  }
  for (const auto encoding : { LASWriter::Encoding::Las, LASWriter::Encoding::Laz })
  {
    const std::string path = outputFolder() + "/full.las";
    const FileSizeLimit limit(1000000);
    LASWriter writer(path, encoding);
    ASSERT_TRUE(writer.begin(description));
    Result<void> done = writer.append(batch);
    done = done ? writer.finish() : done;
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().kind, Error::Kind::Unwritable);
    EXPECT_NE(done.error().what.find("could not be written"), std::string::npos)
      << done.error().what;
    EXPECT_FALSE(fs::exists(path));
  }
}
} // namespace
} // namespace pointfront::test
