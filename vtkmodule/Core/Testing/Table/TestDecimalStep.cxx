#include "pointfront/Table/DecimalStep.h"
#include "pointfront/Table/TableSource.h"

#include "TestBuildClouds.h"

#include <gtest/gtest.h>

namespace
{
using namespace pointfront;
using namespace pointfront::test;

DecimalStep floats(const std::vector<double>& values)
{
  DecimalStep step(ScalarType::Float32);
  for (const double value : values)
  {
    step.add(static_cast<double>(static_cast<float>(value)));
  }
  return step;
}

DecimalStep doubles(const std::vector<double>& values)
{
  DecimalStep step(ScalarType::Float64);
  for (const double value : values)
  {
    step.add(value);
  }
  return step;
}

TEST(DecimalStep, IsTheOneThatAllNumbersHaveInCommon)
{
  EXPECT_EQ(floats({ 12.5, -3.25, 0.0 }).decimals(), 2);
  EXPECT_EQ(floats({ 12.345, 999.999, 0.001, -1023.456 }).decimals(), 3);
  EXPECT_EQ(floats({ 4.0, -17.0, 1e6 }).decimals(), 0);
  EXPECT_EQ(floats({}).decimals(), 0);
  EXPECT_EQ(doubles({ 637012.24, 5849028.314, -431.66 }).decimals(), 3);
  EXPECT_EQ(doubles({ 1e7 + 0.01 * 123456.0, 600000.0 + 0.01 * 7.0 }).decimals(), 2);
  DecimalStep both = floats({ 0.5, NAN, INFINITY });
  both.add(floats({ 0.25 }));
  EXPECT_EQ(both.decimals(), 2);
}

/// A sum that comes near zero has the rounding of its offset.
TEST(DecimalStep, IsTheOneOfSumsThatCrossZero)
{
  for (const double offset : { -3.3, -0.05, -1000.1, 0.7 })
  {
    DecimalStep step;
    DecimalStep half;
    for (int k = 0; k <= 20000; ++k)
    {
      (k % 2 == 0 ? step : half).add(0.001 * k + offset);
    }
    EXPECT_EQ(step.decimals(), 3) << offset;
    step.add(half);
    EXPECT_EQ(step.decimals(), 3) << offset;
  }
  // A small number that no rounding of the others explains.
  EXPECT_NE(doubles({ 17.001, 1e-3 + 1e-12 }).decimals(), 3);
  EXPECT_NE(doubles({ 1e-3 + 1e-12, 17.001 }).decimals(), 3);
}

TEST(DecimalStep, IsNoneForWhatOnlyLooksLikeOne)
{
  EXPECT_FALSE(floats({ 1.0 / 3.0, 0.1 }).decimals()) << "thirds";
  EXPECT_FALSE(floats({ 637012.24, 5849028.31 }).decimals()) << "float has no hundredths there";
  EXPECT_FALSE(floats({ 0.001, 8000.123 }).decimals()) << "nor thousandths here";
  EXPECT_FALSE(floats({ 0x1p-20, 1.0 }).decimals()) << "a binary fraction has twenty decimals";
  EXPECT_FALSE(doubles({ 0.1f, 12.3f }).decimals()) << "floats that were made doubles";
  Random random(5);
  std::vector<double> any;
  for (int i = 0; i < 100; ++i)
  {
    any.push_back(100.0 * random.uniform());
  }
  EXPECT_FALSE(floats(any).decimals());
  EXPECT_FALSE(doubles(any).decimals());
  std::vector<double> rounded = { 0.12345 };
  for (int i = 0; i < 1000; ++i)
  {
    rounded.push_back(std::round(1e4 * random.uniform()) / 1e3);
  }
  EXPECT_EQ(floats(rounded).decimals(), 5);
  rounded[500] += 3e-6;
  EXPECT_FALSE(floats(rounded).decimals()) << "one of a thousand";
}

TEST(DecimalStep, ItsMultiplesAreTheSameFloats)
{
  Random random(6);
  for (int decimals = 0; decimals <= 6; ++decimals)
  {
    const double power = std::pow(10.0, decimals);
    DecimalStep step(ScalarType::Float32);
    for (int i = 0; i < 10000; ++i)
    {
      // The largest is 2^22 steps away.
      const double number = std::round((random.uniform() - 0.5) * 0x1p23) / power;
      const auto value = static_cast<float>(number);
      step.add(double(value));
      ASSERT_EQ(static_cast<float>(std::nearbyint(double(value) * power) / power), value);
    }
    EXPECT_EQ(step.decimals(), decimals);
  }
}

/// x, y and z as float32, three rows a chunk.
class FloatTable final : public PointTable
{
public:
  explicit FloatTable(std::vector<float> values)
    : values_(std::move(values))
  {
  }
  const std::string& path() const override { return path_; }
  const std::string& format() const override { return path_; }
  const std::vector<TableField>& fields() const override { return fields_; }
  const std::vector<std::string>& warnings() const override { return warnings_; }
  std::uint64_t chunkCount() const override { return values_.size() / 3; }
  std::uint64_t chunkRows(std::uint64_t) const override { return 3; }
  Result<void> read(
    std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const override
  {
    block.resize(3, wanted);
    for (std::vector<double>& column : block.columns)
    {
      std::copy_n(
        values_.begin() + static_cast<std::ptrdiff_t>(3 * chunk), column.size(), column.begin());
    }
    return {};
  }

private:
  std::vector<float> values_;
  std::string path_ = "floats";
  std::vector<TableField> fields_ = { { "x", ScalarType::Float32 }, { "y", ScalarType::Float32 },
    { "z", ScalarType::Float32 } };
  std::vector<std::string> warnings_;
};

std::vector<float> millimetreFloats(std::size_t count)
{
  Random random(7);
  std::vector<float> values(count);
  for (float& value : values)
  {
    value = static_cast<float>(std::round(2e6 * (random.uniform() - 0.5)) / 1e3);
  }
  return values;
}

TEST(TableSource, OfDecimalFloatsHasTheirGrid)
{
  const std::vector<float> values = millimetreFloats(3000);
  const auto source = TableSource::open(std::make_unique<FloatTable>(values));
  ASSERT_TRUE(source) << source.error().what;
  const auto& grid = (*source)->description().grid;
  ASSERT_TRUE(grid);
  EXPECT_EQ(grid->scale, glm::dvec3(0.001));
  PointBatch batch;
  for (std::uint64_t chunk = 0; chunk < (*source)->chunkCount(); ++chunk)
  {
    ASSERT_TRUE((*source)->read(chunk, batch));
    for (const glm::dvec3& p : batch.positions)
    {
      EXPECT_EQ(glm::vec3(grid->toWorld(grid->toGrid(p))), glm::vec3(p)) << "another float";
    }
  }
}

TEST(TableSource, OneNumberInAChunkThatTheSampleLeftOutDecides)
{
  for (const std::size_t odd : { 0u, 1000u, 2999u })
  {
    std::vector<float> values = millimetreFloats(3000); // a thousand chunks, 64 in a sample
    values[odd] = 100.0f / 3.0f;
    const auto source = TableSource::open(std::make_unique<FloatTable>(values));
    ASSERT_TRUE(source) << source.error().what;
    EXPECT_FALSE((*source)->description().grid) << odd;
  }
}

TEST(TableSource, OfWideFloatsHasNoGrid)
{
  std::vector<float> values = millimetreFloats(30);
  values[7] = 5000.0f; // where float is twice too coarse for millimetres
  const auto source = TableSource::open(std::make_unique<FloatTable>(values));
  ASSERT_TRUE(source) << source.error().what;
  EXPECT_FALSE((*source)->description().grid);
}
} // namespace
