#include "BytesAsFile.h"
#include "TextFormat.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  pointfront::fuzz::readAsPoints(pointfront::TextFormat({}, { 1, {} }), data, size);
  return 0;
}
