#include "BytesAsFile.h"
#include "PLYFormat.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  pointfront::fuzz::readAsPoints(pointfront::PLYFormat({ 1, {} }), data, size);
  return 0;
}
