#pragma once

#include "FilesInTheMaking.h"
#include "PointValues.h"

#include "pointfront/Points/PointSink.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

/// Duties of every writer of a foreign format, as cases for the tests of each.
namespace pointfront::test
{

/// A writer, and the reader that must understand it.
struct WriterCase
{
  const PointSourceFormat& format;
  std::string extension; ///< without the dot
  std::function<std::unique_ptr<PointSink>(const std::string& path)> make;
};

/// Two points with an attribute of every kind.
inline SinkDescription manyKinds(PointBatch& batch)
{
  SinkDescription description;
  description.schema.add({ "intensity", ScalarType::UInt16 });
  description.schema.add({ "rgb", ScalarType::UInt8, 3 });
  description.schema.add({ "normal", ScalarType::Float32, 3 });
  description.schema.add({ "gps_time", ScalarType::Float64 });
  description.schema.add({ "wave offset", ScalarType::UInt64 });
  description.schema.add({ "pair", ScalarType::Int16, 2 });
  description.schema.add({ "width", ScalarType::Int16, 1, 0.1, 1000.0 });
  batch.resize(2, description.schema);
  batch.positions = { { 637012.24, 849028.31, 431.66 }, { -0.05, 0.0, 12.3456 } };
  const auto fill = [&](std::size_t column, const auto& values)
  { std::memcpy(batch.columns[column].data(), values.data(), batch.columns[column].size()); };
  fill(0, std::vector<std::uint16_t>{ 143, 65535 });
  fill(1, std::vector<std::uint8_t>{ 68, 77, 88, 0, 255, 1 });
  fill(2, std::vector<float>{ 0.0f, 0.6f, 0.8f, 1.0f, 0.0f, 0.0f });
  fill(3, std::vector<double>{ 1.0 / 3.0, 1e9 });
  fill(4, std::vector<std::uint64_t>{ 1ull << 40, 7 });
  fill(5, std::vector<std::int16_t>{ -1, 2, -3, 4 });
  fill(6, std::vector<std::int16_t>{ 3, -10000 });
  return description;
}

/// Writes manyKinds() twice over and reads it. The type of the 64-bit integer "wave_offset", named
/// in `schema`, is the format's.
template <typename WaveOffset>
void expectReadAsWritten(const WriterCase& writerCase, const std::string& schema)
{
  PointBatch batch;
  const SinkDescription description = manyKinds(batch);
  const std::string path = writeFile("written." + writerCase.extension, "");
  std::filesystem::remove(path);
  const auto writer = writerCase.make(path);
  ASSERT_TRUE(writer->begin(description));
  ASSERT_TRUE(writer->append(batch));
  ASSERT_TRUE(writer->append(batch));
  EXPECT_FALSE(std::filesystem::exists(path)) << "whole or absent";
  ASSERT_TRUE(writer->finish());
  const auto source = openPoints(writerCase.format, path);
  ASSERT_TRUE(source);
  EXPECT_TRUE(source->description().warnings.empty());
  const PointBatch all = readPoints(*source);
  ASSERT_EQ(all.size(), 4u);
  EXPECT_EQ(all.positions[2], batch.positions[0]);
  EXPECT_EQ(all.positions[3], batch.positions[1]);
  EXPECT_EQ(schemaText(*source), schema);
  EXPECT_EQ(columnOf<std::uint16_t>(*source, all, "intensity"),
    (std::vector<std::uint16_t>{ 143, 65535, 143, 65535 }));
  EXPECT_EQ(columnOf<std::uint8_t>(*source, all, "rgb"),
    (std::vector<std::uint8_t>{ 68, 77, 88, 0, 255, 1, 68, 77, 88, 0, 255, 1 }));
  EXPECT_EQ(columnOf<float>(*source, all, "normal")[2], 0.8f);
  EXPECT_EQ(columnOf<double>(*source, all, "gps_time")[0], 1.0 / 3.0);
  EXPECT_EQ(columnOf<WaveOffset>(*source, all, "wave_offset")[0], WaveOffset(1ull << 40));
  EXPECT_EQ(columnOf<std::int16_t>(*source, all, "pair"),
    (std::vector<std::int16_t>{ -1, 2, -3, 4, -1, 2, -3, 4 }));
  EXPECT_NEAR(columnOf<double>(*source, all, "width")[0], 1000.3, 1e-9);
}

/// An earlier file stays when a writer is destroyed before finish().
inline void expectNothingLeftUnfinished(const WriterCase& writerCase)
{
  PointBatch batch;
  const SinkDescription description = manyKinds(batch);
  const std::string path = writeFile("kept." + writerCase.extension, "earlier");
  {
    const auto writer = writerCase.make(path);
    ASSERT_TRUE(writer->begin(description));
    ASSERT_TRUE(writer->append(batch));
  }
  EXPECT_EQ(bytesOfFile(path), "earlier");
  EXPECT_TRUE(filesInTheMaking(path).empty());
}

/// A file of no points, and one of a point with a colour of 16 bits.
inline void expectNoneAndWideColour(const WriterCase& writerCase)
{
  SinkDescription description;
  description.schema.add({ "rgb", ScalarType::UInt16, 3 });
  const std::string path = writeFile("wide." + writerCase.extension, "");
  PointBatch batch;
  batch.resize(1, description.schema);
  batch.positions[0] = glm::dvec3(1, 2, 3);
  const std::uint16_t rgb[3] = { 256, 65535, 0 };
  std::memcpy(batch.columns[0].data(), rgb, sizeof rgb);
  for (const int points : { 0, 1 })
  {
    const auto writer = writerCase.make(path);
    ASSERT_TRUE(writer->begin(description));
    ASSERT_TRUE(points == 0 || writer->append(batch).ok());
    ASSERT_TRUE(writer->finish());
    const auto source = openPoints(writerCase.format, path);
    ASSERT_TRUE(source);
    const PointBatch all = readPoints(*source);
    EXPECT_EQ(all.size(), static_cast<std::size_t>(points));
    EXPECT_EQ(columnOf<std::uint16_t>(*source, all, "rgb"),
      std::vector<std::uint16_t>(rgb, rgb + 3 * points));
  }
}

/// Attributes whose names a reader would take for a coordinate, a part of a colour or one another.
inline void expectNamesToldApart(const WriterCase& writerCase)
{
  SinkDescription description;
  description.schema.add({ "intensity", ScalarType::UInt16 });
  description.schema.add({ "z ", ScalarType::UInt16 });
  description.schema.add({ "Intensity", ScalarType::UInt16 });
  description.schema.add({ "red", ScalarType::UInt16 });
  description.schema.add({ "rgb", ScalarType::UInt16, 3 });
  for (const char* name : { "a b", "a_b", "scalar_q", "q" })
  {
    description.schema.add({ name, ScalarType::UInt16 });
  }
  PointBatch batch;
  batch.resize(1, description.schema);
  batch.positions[0] = glm::dvec3(1, 2, 3);
  std::uint16_t value = 500;
  for (std::vector<std::byte>& column : batch.columns)
  {
    value = static_cast<std::uint16_t>(value + 1);
    for (std::size_t at = 0; at < column.size(); at += sizeof value)
    {
      std::memcpy(column.data() + at, &value, sizeof value);
    }
  }
  const std::string path = writeFile("names." + writerCase.extension, "");
  const auto writer = writerCase.make(path);
  ASSERT_TRUE(writer->begin(description));
  ASSERT_TRUE(writer->append(batch));
  ASSERT_TRUE(writer->finish());
  const std::vector<std::string> renamed{ "The attribute 'z ' is written as 'z__2'.",
    "The attribute 'Intensity' is written as 'Intensity_2'.",
    "The attribute 'red' is written as 'red_2'.", "The attribute 'a b' is written as 'a_b_2'.",
    "The attribute 'scalar_q' is written as 'scalar_q_2'." };
  EXPECT_EQ(writer->findings(), renamed);
  const auto source = openPoints(writerCase.format, path);
  ASSERT_TRUE(source);
  const PointBatch all = readPoints(*source);
  EXPECT_EQ(all.positions, batch.positions);
  const AttributeSchema& schema = source->description().schema;
  const std::vector<std::string> names{ "intensity", "z__2", "Intensity_2", "red_2", "rgb", "a_b_2",
    "a_b", "q_2", "q" };
  ASSERT_EQ(schema.size(), names.size());
  for (std::size_t c = 0; c < names.size(); ++c)
  {
    EXPECT_EQ(schema[c].name, names[c]);
    visitScalar(schema[c].type,
      [&](auto first)
      {
        std::memcpy(&first, all.columns[c].data(), sizeof first);
        EXPECT_EQ(static_cast<double>(first), 501.0 + static_cast<double>(c)) << names[c];
      });
  }
}

inline void expectReasonWhenItCannotWrite(const WriterCase& writerCase)
{
  const auto writer =
    writerCase.make(testing::TempDir() + "no such folder/x." + writerCase.extension);
  const Result<void> begun = writer->begin({});
  ASSERT_FALSE(begun.ok());
  EXPECT_NE(begun.error().what.find("no such folder"), std::string::npos);
}

} // namespace pointfront::test
