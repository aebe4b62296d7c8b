#include "LASExtraBytes.h"
#include "LASPointDecoder.h"
#include "LAZIntegerDecoder.h"
#include "RealFiles.h"
#include "SourcePoints.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

namespace pointfront::test
{
namespace
{
void expectEqualPoints(const char* first, const char* second)
{
  const auto a = openOrFail(sharedData(first));
  const auto b = openOrFail(sharedData(second));
  ASSERT_TRUE(a && b);
  ASSERT_EQ(a->description().schema, b->description().schema);
  const PointBatch left = readAll(*a);
  const PointBatch right = readAll(*b);
  ASSERT_EQ(left.size(), right.size());
  EXPECT_TRUE(left.positions == right.positions);
  for (std::size_t c = 0; c < left.columns.size(); ++c)
  {
    EXPECT_TRUE(left.columns[c] == right.columns[c]) << a->description().schema[c].name;
  }
}

TEST(LASPoints, AreEqualInBothEncodingsOfOneCloud)
{
  expectEqualPoints("las/real/autzen_trim.las", "laz/autzen_trim.laz");
  expectEqualPoints("las/real/extrabytes.las", "laz/extrabytes.laz");
  expectEqualPoints("las/real/1.2-with-color.las", "laz/simple.laz");
  expectEqualPoints("laz/simple.laz", "laz/simple-laszip-compressor-version-1.2r0.laz");
}

TEST(LASPoints, AreTheSameForAnyNumberOfThreads)
{
  for (const char* file : { "las/real/autzen_trim.las", "laz/autzen_trim.laz",
         "laz/las1.4_pf8_random.laz", "copc/ellipsoid_200k.copc.laz" })
  {
    SCOPED_TRACE(file);
    const auto source = openOrFail(sharedData(file));
    ASSERT_TRUE(source);
    const PointBatch forwards = readAll(*source);
    const PointBatch backwards = readAllBackwards(*source, 4);
    EXPECT_TRUE(forwards.positions == backwards.positions);
    EXPECT_TRUE(forwards.columns == backwards.columns);
  }
}

/// The first point of the best known file of the field, as PDAL's own tests have it.
TEST(LASPoints, FirstPointHasItsKnownValues)
{
  const auto source = openOrFail(sharedData("las/real/1.2-with-color.las"));
  ASSERT_TRUE(source);
  const AttributeSchema& schema = source->description().schema;
  const PointBatch all = readAll(*source);
  EXPECT_NEAR(all.positions[0].x, 637012.24, 1e-6);
  EXPECT_NEAR(all.positions[0].y, 849028.31, 1e-6);
  EXPECT_NEAR(all.positions[0].z, 431.66, 1e-6);
  const auto value = [&](const char* name, int component = 0)
  { return valuesOf(all, schema, name, component)[0]; };
  EXPECT_EQ(value("intensity"), 143);
  EXPECT_EQ(value("return_number"), 1);
  EXPECT_EQ(value("return_count"), 1);
  EXPECT_EQ(value("classification"), 1);
  EXPECT_EQ(value("scan_direction"), 1);
  EXPECT_EQ(value("edge_of_flight_line"), 0);
  EXPECT_EQ(value("scan_angle"), -9);
  EXPECT_EQ(value("user_data"), 132);
  EXPECT_EQ(value("point_source_id"), 7326);
  EXPECT_NEAR(value("gps_time"), 245380.78254962614, 1e-9);
  EXPECT_EQ(value("rgb", 0), 68);
  EXPECT_EQ(value("rgb", 1), 77);
  EXPECT_EQ(value("rgb", 2), 88);
}

/// A record of every byte different from its neighbours, read field by field from the standard.
TEST(LASPoints, EveryFieldOfFormat10ComesFromItsBytes)
{
  const std::vector<Attribute> extra{ { "height", ScalarType::Float32 } };
  const LASPointLayout layout = makeLASPointLayout(10, extra);
  ASSERT_EQ(layout.pointBytes, 71u);
  std::vector<std::byte> record(layout.pointBytes);
  storeNumber<std::int32_t>(&record[0], -5);
  storeNumber<std::int32_t>(&record[4], 7);
  storeNumber<std::int32_t>(&record[8], 2147483647);
  storeNumber<std::uint16_t>(&record[12], 40000);
  storeNumber<std::uint8_t>(&record[14], 0xB9); // return 9 of 11
  storeNumber<std::uint8_t>(&record[15], 0x6A); // flags 10, channel 2, direction 1, edge 0
  storeNumber<std::uint8_t>(&record[16], 201);
  storeNumber<std::uint8_t>(&record[17], 33);
  storeNumber<std::int16_t>(&record[18], -15000);
  storeNumber<std::uint16_t>(&record[20], 4321);
  storeNumber<double>(&record[22], 3.25);
  storeNumber<std::uint16_t>(&record[30], 1000);
  storeNumber<std::uint16_t>(&record[32], 2000);
  storeNumber<std::uint16_t>(&record[34], 3000);
  storeNumber<std::uint16_t>(&record[36], 4000);
  storeNumber<std::uint8_t>(&record[38], 5);
  storeNumber<std::uint64_t>(&record[39], 1ull << 40);
  storeNumber<std::uint32_t>(&record[47], 600);
  storeNumber<float>(&record[51], 7.5f);
  storeNumber<float>(&record[55], 8.5f);
  storeNumber<float>(&record[59], 9.5f);
  storeNumber<float>(&record[63], 10.5f);
  storeNumber<float>(&record[67], 11.5f);

  PointBatch batch;
  batch.resize(1, layout.schema);
  const QuantisationGrid grid{ glm::dvec3(0.5), glm::dvec3(100.0, 200.0, 300.0) };
  decodeLASPoints(layout, grid, record.data(), 1, batch);
  EXPECT_EQ(batch.positions[0], glm::dvec3(97.5, 203.5, 300.0 + 0.5 * 2147483647));
  const std::pair<const char*, double> expected[] = { { "intensity", 40000 },
    { "return_number", 9 }, { "return_count", 11 }, { "classification", 201 },
    { "classification_flags", 10 }, { "scan_direction", 1 }, { "edge_of_flight_line", 0 },
    { "scanner_channel", 2 }, { "scan_angle", -90.0 }, { "user_data", 33 },
    { "point_source_id", 4321 }, { "gps_time", 3.25 }, { "rgb", 1000 }, { "nir", 4000 },
    { "wave_descriptor", 5 }, { "wave_offset", 1099511627776.0 }, { "wave_size", 600 },
    { "wave_return_location", 7.5 }, { "wave_vector", 8.5 }, { "height", 11.5 } };
  ASSERT_EQ(layout.schema.size(), std::size(expected));
  for (const auto& [name, value] : expected)
  {
    EXPECT_EQ(valuesOf(batch, layout.schema, name)[0], value) << name;
  }
  EXPECT_EQ(valuesOf(batch, layout.schema, "rgb", 2)[0], 3000);
  EXPECT_EQ(valuesOf(batch, layout.schema, "wave_vector", 2)[0], 10.5);
}

TEST(LASPoints, FlagsOfOldFormatsAreSplitFromTheClass)
{
  const LASPointLayout layout = makeLASPointLayout(0, {});
  std::vector<std::byte> record(layout.pointBytes);
  storeNumber<std::uint8_t>(&record[14], 0xDA); // return 2 of 3, direction 1, edge 1
  storeNumber<std::uint8_t>(&record[15], 0xA6); // class 6, synthetic and withheld
  storeNumber<std::int8_t>(&record[16], -90);
  PointBatch batch;
  batch.resize(1, layout.schema);
  decodeLASPoints(layout, {}, record.data(), 1, batch);
  const std::pair<const char*, double> expected[] = { { "return_number", 2 }, { "return_count", 3 },
    { "scan_direction", 1 }, { "edge_of_flight_line", 1 }, { "classification", 6 },
    { "classification_flags", 5 }, { "scan_angle", -90 } };
  for (const auto& [name, value] : expected)
  {
    EXPECT_EQ(valuesOf(batch, layout.schema, name)[0], value) << name;
  }
}

TEST(LASPoints, EveryScanAngleSurvivesFloat)
{
  for (int angle = -32768; angle <= 32767; ++angle)
  {
    const auto degrees = static_cast<float>(0.006 * angle);
    ASSERT_EQ(std::lround(double{ degrees } / 0.006), angle);
  }
}

TEST(LASExtraBytes, OfTheirFilesHaveNamesTypesAndScales)
{
  const auto source = openOrFail(sharedData("las/real/extrabytes.las"));
  ASSERT_TRUE(source);
  const AttributeSchema& schema = source->description().schema;
  const std::pair<const char*, Attribute> expected[] = {
    { "Colors", { "Colors", ScalarType::UInt16, 3 } },
    { "Reserved", { "Reserved", ScalarType::UInt8, 7 } },
    { "Flags", { "Flags", ScalarType::Int8, 2 } },
    { "Intensity", { "Intensity", ScalarType::UInt32 } },
    { "Time", { "Time", ScalarType::UInt64 } },
  };
  for (const auto& [name, attribute] : expected)
  {
    const auto column = schema.find(name);
    ASSERT_TRUE(column) << name;
    EXPECT_EQ(schema[*column], attribute) << name;
  }
  // The file's author derived them from the standard fields.
  const PointBatch all = readAll(*source);
  for (int k = 0; k < 3; ++k)
  {
    EXPECT_EQ(valuesOf(all, schema, "Colors", k), valuesOf(all, schema, "rgb", k));
  }
  EXPECT_EQ(valuesOf(all, schema, "Intensity"), valuesOf(all, schema, "intensity"));
}

TEST(LASExtraBytes, WithoutDescriptorsStayBytes)
{
  std::vector<std::string> warnings;
  const std::vector<Attribute> attributes = parseExtraBytes({}, 21, warnings);
  ASSERT_EQ(attributes.size(), 2u);
  EXPECT_EQ(attributes[0], (Attribute{ "extra", ScalarType::UInt8, 16 }));
  EXPECT_EQ(attributes[1], (Attribute{ "extra", ScalarType::UInt8, 5 }));
  EXPECT_EQ(makeLASPointLayout(0, attributes).schema[11].name, "extra_2");
  EXPECT_EQ(warnings.size(), 0u);
}

TEST(LASExtraBytes, AreReadBackFromWhatIsComposed)
{
  const std::vector<Attribute> attributes{ { "a", ScalarType::Int16, 1, 0.01, -5.0, "scaled" },
    { "b", ScalarType::Float64, 2 }, { "c", ScalarType::UInt64, 3 }, { "d", ScalarType::UInt8, 16 },
    { "e", ScalarType::Int8 } };
  const std::vector<std::byte> payload = composeExtraBytes(attributes, {});
  std::vector<std::string> warnings;
  const std::vector<Attribute> back =
    parseExtraBytes({ { payload.data(), payload.size() } }, 2 + 16 + 24 + 16 + 1, warnings);
  EXPECT_EQ(back, attributes);
  EXPECT_EQ(back[0].description, "scaled");
  EXPECT_EQ(warnings.size(), 0u);
}

TEST(LASExtraBytes, ThatDoNotFitTheRecordLoseTheirNamesWithAWarning)
{
  const std::vector<Attribute> attributes{ { "a", ScalarType::Int16 },
    { "b", ScalarType::Float64 } };
  const std::vector<std::byte> payload = composeExtraBytes(attributes, {});
  std::vector<std::string> warnings;
  const std::vector<Attribute> back =
    parseExtraBytes({ { payload.data(), payload.size() } }, 7, warnings);
  ASSERT_EQ(back.size(), 2u);
  EXPECT_EQ(back[0], attributes[0]);
  EXPECT_EQ(back[1], (Attribute{ "extra", ScalarType::UInt8, 5 }));
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("the names of 1 attributes were lost"), std::string::npos);
}

TEST(LASExtraBytes, KeepADescriptorThatSaysTheSame)
{
  const std::vector<Attribute> attributes{ { "a", ScalarType::Int16, 1, 0.5, 0.0 } };
  std::vector<std::byte> original = composeExtraBytes(attributes, {});
  storeNumber<std::int64_t>(&original[40], -32768); // its no-data value
  const std::vector<std::byte> again =
    composeExtraBytes(attributes, { { original.data(), original.size() } });
  EXPECT_EQ(again, original);
}

TEST(LAZIntegerDecoder, StopsWhereTheBytesEnd)
{
  const std::vector<std::byte> zeros(6);
  LAZIntegerDecoder decoder({ zeros.data(), zeros.size() });
  int decoded = 0;
  while (decoded < 100000 && decoder.next(0, 1))
  {
    ++decoded;
  }
  EXPECT_LT(decoded, 100000);
}
} // namespace
} // namespace pointfront::test
