#include "InputLists.h"

#include "ItemCollection.h"
#include "STACFormat.h"

#include "pointfront/Base/FileNames.h"
#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Disk/SmallFile.h"
#include "pointfront/Query/InputBox.h"
#include "pointfront/Tiles/TileFormat.h"

#include <filesystem>

namespace pointfront
{
namespace
{
Result<void> addItems(const std::string& path, InputBox* box, ListedInputs& inputs)
{
  const Result<std::string> text = readSmallText(path, STACFormat::mostListBytes);
  if (!text)
  {
    return text.error();
  }
  const Result<ItemCollection> list = ItemCollection::parse(*text, path);
  if (!list)
  {
    return list.error();
  }
  FileNames seen;
  for (const STACItem& item : list->items)
  {
    if (box != nullptr && item.bounds && !item.bounds->overlaps(box->bounds()))
    {
      box->leaveOut(*item.bounds);
      continue;
    }
    const Result<std::string> address = resolvedHref(path, item.href);
    if (!address)
    {
      return address.error();
    }
    std::string file = publicForm(*address);
    if (!seen.add(file))
    {
      inputs.files.push_back(std::move(file));
    }
  }
  for (const std::string& warning : list->warnings)
  {
    inputs.warnings.push_back(path + ": " + warning);
  }
  return {};
}
} // namespace

Result<ListedInputs> withoutLists(const std::vector<std::string>& arguments, InputBox* box)
{
  ListedInputs inputs;
  for (const std::string& argument : arguments)
  {
    std::error_code failure;
    if (isAddress(argument) || !std::filesystem::is_regular_file(argument, failure))
    {
      inputs.files.push_back(argument);
    }
    else if (std::filesystem::path(argument).extension() == ".pfronts")
    {
      const Result<std::vector<std::string>> names = readTileList(argument);
      if (!names)
      {
        return names.error();
      }
      for (const std::string& name : *names)
      {
        inputs.files.push_back(publicForm(name));
      }
    }
    else if (STACFormat().accepts(argument))
    {
      if (Result<void> added = addItems(argument, box, inputs); !added)
      {
        return added.error();
      }
    }
    else
    {
      inputs.files.push_back(argument);
    }
  }
  if (box != nullptr && inputs.files.empty() && !arguments.empty())
  {
    return box->nothingInside();
  }
  return inputs;
}

} // namespace pointfront
