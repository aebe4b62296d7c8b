#include "FileBytes.h"
#include "LASExport.h"
#include "LASWriter.h"
#include "SourcePoints.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace pointfront::test
{
namespace
{
SinkDescription described(const std::vector<Attribute>& attributes)
{
  SinkDescription description;
  description.grid.scale = glm::dvec3(0.01);
  for (const Attribute& attribute : attributes)
  {
    description.schema.add(attribute);
  }
  return description;
}

int chosenFormat(const SinkDescription& description)
{
  const Result<LASExport> plan = LASExport::plan(description, "out.las");
  EXPECT_TRUE(plan) << plan.error().what;
  return plan ? plan->layout.pointFormat : -1;
}

/// One column of a batch.
template <typename T>
std::vector<std::byte> bytesOf(const std::vector<T>& values)
{
  const auto* const first = reinterpret_cast<const std::byte*>(values.data());
  return { first, first + values.size() * sizeof(T) };
}

const Attribute angle{ "scan_angle", ScalarType::Float32 };

TEST(LASFieldChoice, TakesANewerFormatForAnglesThatAreNoWholeDegreesFrom90To90)
{
  SinkDescription description = described({ angle });
  EXPECT_EQ(chosenFormat(description), 0) << "nobody knows";
  struct Case
  {
    double smallest;
    double largest;
    int format;
  };
  constexpr double any = std::numeric_limits<float>::max();
  for (const Case& c : { Case{ -90.0, 90.0, 0 }, { -91.0, 90.0, 6 }, { -90.0, 91.0, 6 },
         { -12.5, 13.0, 6 }, { -12.0, 13.5, 6 }, { -any, any, 0 } })
  {
    description.smallest = { c.smallest };
    description.largest = { c.largest };
    EXPECT_EQ(chosenFormat(description), c.format) << c.smallest << " to " << c.largest;
  }
}

TEST(LASFieldChoice, ExtraBytesHaveNamesOf32BytesThatNoOtherHas)
{
  const std::string base(30, 'n');
  const std::string umlauts = "hhhhhhhhhhhhhhhhhhhhhhhhhhhhhhh\u00e4x"; // 31 bytes, 2 and 1
  const SinkDescription description =
    described({ { base + "XXlong", ScalarType::Float32 }, { base + "XX", ScalarType::Int16 },
      { base + "XXother", ScalarType::UInt8 }, { umlauts, ScalarType::Float64 },
      { base + "YYvector", ScalarType::Float32, 5 }, { "plain", ScalarType::UInt16, 3 },
      { "five", ScalarType::UInt16, 4 }, { "five[1]", ScalarType::UInt16 } });
  const Result<LASExport> plan = LASExport::plan(description, "out.las");
  ASSERT_TRUE(plan) << plan.error().what;
  const AttributeSchema& schema = plan->layout.schema;
  std::vector<std::string> names;
  for (std::size_t c = makeLASPointLayout(0, {}).schema.size(); c < schema.size(); ++c)
  {
    names.push_back(schema[c].name);
  }
  const std::string index = base.substr(1);
  const std::vector<std::string> expected = { base + "_2", base + "XX", base + "_3",
    std::string(31, 'h'), index + "[0]", index + "[1]", index + "[2]", index + "[3]", index + "[4]",
    "plain", "five[0]", "five[1]", "five[2]", "five[3]", "five_2[1]" };
  EXPECT_EQ(names, expected);
  EXPECT_EQ(plan->changes.size(), 9u) << "each change is told, and nothing else";
  EXPECT_EQ(plan->changes[0],
    "The attribute '" + base + "XXlong' is written as '" + base + "_2': LAS has 32 bytes for a " +
      "name.");
  EXPECT_NE(plan->changes.back().find("another one has its name"), std::string::npos);
}

/// Writes a batch as LAS; gives what the writer found.
std::vector<std::string> findingsOf(
  const SinkDescription& description, const PointBatch& batch, const std::string& path)
{
  LASWriter writer(path);
  EXPECT_TRUE(writer.begin(description));
  EXPECT_TRUE(writer.append(batch));
  EXPECT_TRUE(writer.finish());
  return writer.findings();
}

TEST(LASFieldChoice, CountsTheAnglesThatItRounds)
{
  const std::string path = outputFolder() + "/angles.las";
  SinkDescription description = described({ angle });
  PointBatch batch;
  batch.resize(3, description.schema);
  batch.columns[0] = bytesOf<float>({ 12.4f, -7.0f, 12.5004f });
  struct Case
  {
    std::vector<double> smallest;
    std::vector<double> largest;
    double written[3];
    const char* finding;
  };
  for (const Case& c :
    { Case{ {}, {}, { 12.0, -7.0, 13.0 },
        "2 scan angles are rounded to the steps of LAS point format 0, whole degrees." },
      { { -7.0 }, { 12.5004 }, { 12.402, -7.002, 12.498 },
        "3 scan angles are rounded to the steps of LAS point format 6, 0.006 degrees." } })
  {
    description.smallest = c.smallest;
    description.largest = c.largest;
    const std::vector<std::string> found = findingsOf(description, batch, path);
    ASSERT_EQ(found.size(), 1u);
    EXPECT_EQ(found[0], c.finding);
    const auto source = openOrFail(path);
    ASSERT_TRUE(source);
    const PointBatch back = readAll(*source);
    for (std::size_t i = 0; i < 3; ++i)
    {
      EXPECT_NEAR(
        valuesOf(back, source->description().schema, "scan_angle")[i], c.written[i], 1e-5);
    }
    // Angles of its own are none to round.
    SinkDescription again = description;
    again.smallest = { -7.002 };
    PointBatch own = batch;
    own.columns[0] = back.columns[*source->description().schema.find("scan_angle")];
    EXPECT_TRUE(findingsOf(again, own, outputFolder() + "/again.las").empty());
  }
}

/// One column of integers as it comes back: the field, and the extra bytes with all values.
struct Split
{
  std::vector<double> field;
  std::vector<double> exact;
  std::string finding;
};

template <typename T>
Split split(const Attribute& attribute, const std::vector<T>& values)
{
  SinkDescription description = described({ attribute });
  description.smallest = { static_cast<double>(*std::min_element(values.begin(), values.end())) };
  description.largest = { static_cast<double>(*std::max_element(values.begin(), values.end())) };
  PointBatch batch;
  batch.resize(values.size(), description.schema);
  batch.columns[0] = bytesOf(values);
  const std::string path = outputFolder() + "/split.las";
  const std::vector<std::string> found = findingsOf(description, batch, path);
  const auto source = openOrFail(path);
  EXPECT_EQ(found.size(), 1u);
  EXPECT_TRUE(source);
  if (!source || found.size() != 1)
  {
    return {};
  }
  const PointBatch back = readAll(*source);
  const AttributeSchema& schema = source->description().schema;
  return { valuesOf(back, schema, attribute.name.c_str()),
    valuesOf(back, schema, (attribute.name + "_exact").c_str()), found[0] };
}

TEST(LASFieldChoice, KeepsTheValuesThatTheFieldHolds)
{
  const Split wide =
    split<std::int16_t>({ "classification", ScalarType::Int16 }, { 2, 300, 255, -1, 0, 6 });
  EXPECT_EQ(wide.field, (std::vector<double>{ 2, 1, 255, 1, 0, 6 }));
  EXPECT_EQ(wide.exact, (std::vector<double>{ 2, 300, 255, -1, 0, 6 }));
  EXPECT_EQ(wide.finding,
    "2 values of 'classification' are beyond LAS's own field, which ends at 255: it is 1 there, "
    "and extra bytes 'classification_exact' hold the values of all points.");
  const Split bits = split<std::uint8_t>({ "return_number", ScalarType::UInt8 }, { 1, 15, 16 });
  EXPECT_EQ(bits.field, (std::vector<double>{ 1, 15, 0 }));
  EXPECT_EQ(bits.exact, (std::vector<double>{ 1, 15, 16 }));
  const Split long64 =
    split<std::uint64_t>({ "point_source_id", ScalarType::UInt64 }, { 65535, 65536, 1ull << 40 });
  EXPECT_EQ(long64.field, (std::vector<double>{ 65535, 0, 0 }));
  EXPECT_EQ(long64.exact, (std::vector<double>{ 65535, 65536, 0x1p40 }));
  const Split far = split<float>(angle, { 180.0f, 200.0f });
  EXPECT_EQ(far.field, (std::vector<double>{ 180, 0 }));
  EXPECT_EQ(far.exact, (std::vector<double>{ 180, 200 }));
}

TEST(LASFieldChoice, GivesExtraBytesNamesThatNobodyHas)
{
  SinkDescription description = described(
    { { "classification", ScalarType::UInt16 }, { "classification_exact", ScalarType::UInt16 } });
  description.smallest = { 0, 0 };
  description.largest = { 300, 300 };
  PointBatch batch;
  batch.resize(2, description.schema);
  batch.columns[0] = bytesOf<std::uint16_t>({ 2, 300 });
  batch.columns[1] = bytesOf<std::uint16_t>({ 7, 8 });
  const std::string path = outputFolder() + "/names.las";
  EXPECT_EQ(findingsOf(description, batch, path).size(), 1u);
  const auto source = openOrFail(path);
  ASSERT_TRUE(source);
  const PointBatch back = readAll(*source);
  const AttributeSchema& schema = source->description().schema;
  EXPECT_EQ(valuesOf(back, schema, "classification"), (std::vector<double>{ 2, 1 }));
  EXPECT_EQ(valuesOf(back, schema, "classification_exact"), (std::vector<double>{ 7, 8 }));
  EXPECT_EQ(valuesOf(back, schema, "classification_exact_2"), (std::vector<double>{ 2, 300 }));
}

} // namespace
} // namespace pointfront::test
