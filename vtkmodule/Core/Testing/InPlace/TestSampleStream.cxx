#include "pointfront/InPlace/SampleStream.h"

#include <gtest/gtest.h>

#include <cstdint>

namespace pointfront
{

TEST(SampleStream, TakesOnePointOfEveryStratum)
{
  for (unsigned logStep = 0; logStep < 12; ++logStep)
  {
    const SampleStream stream{ logStep };
    for (std::uint64_t stratum = 0; stratum < 50; ++stratum)
    {
      const std::uint64_t point = stream.sample(stratum);
      EXPECT_EQ(point >> logStep, stratum);
      EXPECT_TRUE(stream.contains(point));
      EXPECT_FALSE(logStep > 0 && stream.contains(point ^ 1));
    }
  }
}

} // namespace pointfront
