#include "Percentiles.h"

#include <gtest/gtest.h>

namespace pointfront
{

TEST(Percentiles, AreValuesThatWereMeasured)
{
  std::vector<double> values;
  for (int i = 100; i >= 1; --i)
  {
    values.push_back(i);
  }
  const Percentiles p = percentilesOf(values);
  EXPECT_EQ(p.p50, 50.0);
  EXPECT_EQ(p.p95, 95.0);
  EXPECT_EQ(p.p99, 99.0);
  EXPECT_EQ(p.max, 100.0);
}

TEST(Percentiles, OfOneAndOfNone)
{
  EXPECT_EQ(percentilesOf({ 3.0 }).p50, 3.0);
  EXPECT_EQ(percentilesOf({}).max, 0.0);
}

} // namespace pointfront
