#include "BytesAsFile.h"
#include "PCDFormat.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  pointfront::fuzz::readAsPoints(pointfront::PCDFormat({ 1, {} }), data, size);
  return 0;
}
