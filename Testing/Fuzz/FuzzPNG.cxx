#include "BytesAsFile.h"
#include "PNGReader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const pointfront::fuzz::BytesAsFile file(data, size);
  pointfront::PNGLimits limits;
  limits.pixels = 1 << 22;
  const pointfront::Result<pointfront::Picture> read = pointfront::readPNG(file.path(), limits);
  if (!read)
  {
    pointfront::fuzz::require(!read.error().what.empty(), "an Error says what happened");
    return 0;
  }
  pointfront::fuzz::require(
    read->pixels() <= limits.pixels && read->rgba.size() == 4 * read->pixels(),
    "a picture has its pixels, and no more than the limit");
  return 0;
}
