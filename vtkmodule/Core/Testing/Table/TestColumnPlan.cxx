#include "pointfront/Table/ColumnPlan.h"

#include <gtest/gtest.h>

namespace pointfront
{
namespace
{
FieldStatistics range(double low, double high)
{
  FieldStatistics statistics;
  statistics.add(low);
  statistics.add(high);
  return statistics;
}

/// "name type components" of the plan's attributes.
std::string planned(
  const std::vector<TableField>& fields, const std::vector<FieldStatistics>& statistics)
{
  Result<ColumnPlan> plan = ColumnPlan::make(fields, statistics, "file");
  if (!plan)
  {
    return plan.error().what;
  }
  std::string text;
  for (const Attribute& attribute : plan->schema)
  {
    text += (text.empty() ? "" : ", ") + attribute.name + " " + std::string(nameOf(attribute.type));
    text += attribute.components > 1 ? "x" + std::to_string(attribute.components) : "";
  }
  return text;
}

const TableField x{ "X", ScalarType::Float64 };
const TableField y{ "Y", ScalarType::Float64 };
const TableField z{ "Z", ScalarType::Float64 };

TEST(ColumnPlan, FindsWellKnownNamesInAnySpelling)
{
  EXPECT_EQ(planned({ x, y, z, { "scalar_Intensity", ScalarType::UInt16 },
                      { "ReturnNumber", ScalarType::UInt8 }, { "pt_src_id", ScalarType::UInt16 },
                      { "scalar_Roughness", ScalarType::Float32 } },
              std::vector<FieldStatistics>(7)),
    "intensity uint16, return_number uint8, point_source_id uint16, Roughness float32");
}

TEST(ColumnPlan, NarrowsAWellKnownAttributeOnlyIfAllValuesFit)
{
  const std::vector<TableField> fields{ x, y, z, { "intensity", ScalarType::Float64 } };
  const auto intensity = [&](const FieldStatistics& values) {
    return planned(fields, { {}, {}, {}, values });
  };
  EXPECT_EQ(intensity(range(0, 65535)), "intensity uint16");
  EXPECT_EQ(intensity(range(0, 65536)), "intensity float64");
  EXPECT_EQ(intensity(range(-1, 5)), "intensity float64");
  EXPECT_EQ(intensity(range(0, 0.5)), "intensity float64");
  EXPECT_EQ(undecidedFields(fields), (std::vector<bool>{ false, false, false, true }));
}

TEST(ColumnPlan, GivesTextTheSmallestTypes)
{
  const auto text = [&](FieldStatistics values, int digits)
  {
    values.digits = digits;
    return planned({ x, y, z, { "q", std::nullopt } }, { {}, {}, {}, values });
  };
  EXPECT_EQ(text(range(0, 255), 3), "q uint8");
  EXPECT_EQ(text(range(-1, 127), 3), "q int8");
  EXPECT_EQ(text(range(-129, 0), 3), "q int16");
  EXPECT_EQ(text(range(0, 4294967295.0), 10), "q uint32");
  EXPECT_EQ(text(range(-5e9, 0), 10), "q int64");
  EXPECT_EQ(text(range(0, 0.5), 6), "q float32");
  EXPECT_EQ(text(range(0, 0.5), 7), "q float64");
  FieldStatistics tiny = range(0, 0.5);
  tiny.decimals = 40; // 1e-40 is 9.99995e-41 as float32
  EXPECT_EQ(text(tiny, 1), "q float64");
}

TEST(ColumnPlan, NeedsAllThreeForAVector)
{
  EXPECT_EQ(planned({ x, y, z, { "nx", ScalarType::Float32 }, { "ny", ScalarType::Float32 } },
              std::vector<FieldStatistics>(5)),
    "nx float32, ny float32");
  EXPECT_EQ(planned({ x, y, z, { "b", ScalarType::UInt8 }, { "g", ScalarType::UInt8 },
                      { "r", ScalarType::UInt16 } },
              std::vector<FieldStatistics>(6)),
    "rgb uint16x3");
}

TEST(ColumnPlan, KeepsArraysOfWholeIndices)
{
  EXPECT_EQ(planned({ x, y, z, { "a[0]", ScalarType::Int8 }, { "a[1]", ScalarType::Int8 },
                      { "b[1]", ScalarType::Int8 }, { "c[0]", ScalarType::Int8 } },
              std::vector<FieldStatistics>(7)),
    "a int8x2, b[1] int8, c int8");
}

TEST(ColumnPlan, NamesTheSecondOfOneNameOtherwise)
{
  EXPECT_EQ(planned({ x, y, z, { "t", ScalarType::Int8 }, { "t", ScalarType::Int8 } },
              std::vector<FieldStatistics>(5)),
    "t int8, t_2 int8");
}

TEST(ColumnPlan, CountsColoursThatAreNoFiniteNumbers)
{
  const ScalarType type = ScalarType::Float32;
  std::vector<FieldStatistics> statistics(5, range(0, 1));
  const std::vector<TableField> fields{ x, y, { "r", type }, { "g", type }, { "b", type } };
  const auto warnings = [&]
  {
    std::vector<std::string> all = ColumnPlan::make(fields, statistics, "file")->warnings;
    all.erase(all.begin()); // there is no z
    return all;
  };
  EXPECT_TRUE(warnings().empty());
  statistics[3].add(std::nan(""));
  FieldStatistics others;
  others.add(std::nan(""));
  others.add(-HUGE_VAL);
  statistics[4].add(others);
  ASSERT_EQ(warnings().size(), 1u);
  EXPECT_EQ(warnings()[0].find("3 values of the colour 'r', 'g', 'b' are NaN or infinite"), 0u);
  statistics[2] = range(-1, 1); // no colour, so they stay what they are
  ASSERT_EQ(warnings().size(), 1u);
  EXPECT_NE(warnings()[0].find("are no colour"), std::string::npos);
}

TEST(ColumnPlan, RefusesWhatHasNoPosition)
{
  EXPECT_NE(
    planned({ x, z }, std::vector<FieldStatistics>(2)).find("no x and y"), std::string::npos);
  EXPECT_NE(planned({ x, y, x }, std::vector<FieldStatistics>(3)).find("twice"), std::string::npos);
  const auto flat = ColumnPlan::make({ x, y }, std::vector<FieldStatistics>(2), "file");
  ASSERT_TRUE(flat.ok());
  EXPECT_EQ(flat->warnings.size(), 1u);
}
} // namespace
} // namespace pointfront
