#include "BytesAsFile.h"

#include "StyleJSON.h"

#include <string_view>

/// A parsed sheet is written as text that parses to an equal sheet.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace pointfront;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const Result<StyleSheet> sheet = parseStyleSheet(text);
  if (!sheet)
  {
    fuzz::require(!sheet.error().what.empty(), "an Error says what happened");
  }
  else
  {
    const std::string written = writeStyleSheet(*sheet);
    const Result<StyleSheet> again = parseStyleSheet(written);
    fuzz::require(bool(again), "a sheet that is written can be read");
    fuzz::require(writeStyleSheet(*again) == written, "and is the same sheet");
  }
  const Result<LayerStyle> layer = parseLayerStyle(text);
  fuzz::require(layer || !layer.error().what.empty(), "an Error says what happened");
  return 0;
}
