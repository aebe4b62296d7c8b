#include "LASFormat.h"

#include <gtest/gtest.h>

namespace pointfront
{
TEST(LASFormat, RefusesAMissingFile)
{
  LASFormat format;
  EXPECT_FALSE(format.accepts("no/such/file.las"));
}
} // namespace pointfront
