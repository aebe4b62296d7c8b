#include "BytesAsFile.h"
#include "EPTRecords.h"

#include <string_view>

/// The description, a page of the hierarchy and a node, from the same bytes.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace pointfront;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const Result<EPTDescription> tree = EPTDescription::parse(text, "ept.json");
  if (tree)
  {
    fuzz::require(tree->recordBytes() > 0, "a record has bytes");
  }
  else
  {
    fuzz::require(!tree.error().what.empty(), "an Error says what happened");
  }
  if (const Result<EPTPage> page = parseEPTPage(text, "page"))
  {
    for (const auto& [key, count] : page.value())
    {
      fuzz::require(count >= -1 && key.find('/') == std::string::npos, "keys are no paths");
    }
  }
  constexpr std::size_t expected = 1000;
  if (const auto records = eptRecords(text, EPTEncoding::Zstandard, expected, "node"))
  {
    fuzz::require(records->size() == expected, "a node has the bytes of its points");
  }
  return 0;
}
