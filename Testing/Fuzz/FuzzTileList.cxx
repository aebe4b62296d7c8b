#include "BytesAsFile.h"

#include "pointfront/Tiles/TileFormat.h"

#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace pointfront;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (const auto names = parseTileList(text, "list.pfronts"))
  {
    fuzz::require(!names->empty(), "a list names a store");
    for (const std::string& name : *names)
    {
      fuzz::require(!name.empty() && name.find('\n') == std::string::npos, "a name is a line");
    }
  }
  return 0;
}
