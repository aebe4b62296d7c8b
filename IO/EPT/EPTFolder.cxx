#include "EPTFolder.h"

#include "pointfront/Disk/SmallFile.h"

#include <filesystem>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::uint64_t mostDescriptionBytes = std::uint64_t(16) << 20;
/// Bytes in a node's file beside its points: header, coordinate system, chunk table.
constexpr std::uint64_t mostBesidePoints = std::uint64_t(16) << 20;
} // namespace

Result<std::shared_ptr<const EPTFolder>> EPTFolder::open(const std::string& path)
{
  const Result<std::string> text = readSmallText(path, mostDescriptionBytes);
  if (!text)
  {
    return text.error();
  }
  Result<EPTDescription> description = EPTDescription::parse(*text, path);
  if (!description)
  {
    return description.error();
  }
  auto tree = std::make_shared<EPTFolder>();
  tree->path = path;
  tree->folder = std::filesystem::absolute(path).parent_path().string();
  tree->descriptionBytes = text->size();
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

Result<RawBytes> EPTFolder::readNode(std::uint64_t node) const
{
  const std::uint64_t points = nodes[static_cast<std::size_t>(node)].points;
  return readSmallFile(fileOf(node), mostBesidePoints + 2 * points * description.recordBytes());
}

} // namespace pointfront
