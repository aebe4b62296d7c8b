#include "BytesAsFile.h"
#include "ItemCollection.h"

#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace pointfront;
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  if (const auto list = ItemCollection::parse(text, "list.vpc"))
  {
    fuzz::require(!list->items.empty(), "a list names a file");
    for (const STACItem& item : list->items)
    {
      fuzz::require(!item.href.empty(), "an item has a name");
      fuzz::require(!item.bounds || !item.bounds->empty(), "a box is one");
      if (const auto far = resolvedHref("https://host/a/list.vpc", item.href))
      {
        fuzz::require(far->find("://") != std::string::npos, "beside an address lie addresses");
      }
      static_cast<void>(resolvedHref("a/list.vpc", item.href));
    }
  }
  return 0;
}
