#include "BytesAsFile.h"
#include "LASFormat.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  pointfront::fuzz::readAsPoints(pointfront::LASFormat(), data, size);
  return 0;
}
