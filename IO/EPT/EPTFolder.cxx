#include "EPTFolder.h"

#include "pointfront/Base/MemoryMap.h"

#include <filesystem>
#include <string_view>
#include <utility>

namespace pointfront
{

Result<std::shared_ptr<const EPTFolder>> EPTFolder::open(const std::string& path)
{
  const Result<MemoryMap> map = MemoryMap::open(path);
  if (!map)
  {
    return map.error();
  }
  const std::string_view text(reinterpret_cast<const char*>(map->data()), map->size());
  Result<EPTDescription> description = EPTDescription::parse(text, path);
  if (!description)
  {
    return description.error();
  }
  auto tree = std::make_shared<EPTFolder>();
  tree->path = path;
  tree->folder = std::filesystem::absolute(path).parent_path().string();
  tree->descriptionBytes = map->size();
  tree->description = std::move(*description);
  Result<std::vector<EPTNode>> nodes = readEPTHierarchy(tree->folder);
  if (!nodes)
  {
    return nodes.error();
  }
  tree->nodes = std::move(*nodes);
  return std::shared_ptr<const EPTFolder>(std::move(tree));
}

std::string EPTFolder::fileOf(std::uint64_t node) const
{
  const char* const ending = description.encoding == EPTEncoding::Laszip ? ".laz"
    : description.encoding == EPTEncoding::Binary                        ? ".bin"
                                                                         : ".zst";
  return folder + "/ept-data/" + nodes[static_cast<std::size_t>(node)].key + ending;
}

} // namespace pointfront
