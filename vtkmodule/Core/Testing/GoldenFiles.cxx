#include "GoldenFiles.h"

std::string pointfront::goldenFile(const std::string& name)
{
  return POINTFRONT_CORE_TEST_DATA "/" + name;
}
