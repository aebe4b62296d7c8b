#include "EPTFolder.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Disk/SmallFile.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::uint64_t mostDescriptionBytes = std::uint64_t(16) << 20;
/// Bytes in a node's file beside its points: header, coordinate system, chunk table.
constexpr std::uint64_t mostBesidePoints = std::uint64_t(16) << 20;
constexpr std::size_t firstBytes = std::size_t(64) << 10;

Result<std::string> textOf(const Result<RawBytes>& file)
{
  return file
    ? Result<std::string>(std::string(reinterpret_cast<const char*>(file->data.get()), file->size))
    : file.error();
}
} // namespace

Result<std::shared_ptr<const EPTFolder>> EPTFolder::open(const std::string& path, EPTDepth depth)
{
  auto tree = std::make_shared<EPTFolder>();
  tree->path = path;
  tree->place = isAddress(path) ? path : std::filesystem::absolute(path).string();
  std::vector<SmallFile> files{ { path, mostDescriptionBytes } };
  if (isAddress(path))
  {
    // Both are needed in any case: one round trip.
    files.push_back({ pathOfEPTPage(path), mostEPTPageBytes });
  }
  const ReadStop never{ false };
  const std::vector<Result<RawBytes>> read = readSmallFiles(files, never);
  const Result<std::string> text = textOf(read.front());
  if (!text)
  {
    return text.error();
  }
  Result<EPTDescription> description = EPTDescription::parse(*text, path);
  if (!description)
  {
    return description.error();
  }
  tree->descriptionBytes = text->size();
  tree->description = std::move(*description);
  Result<std::shared_ptr<const ByteSource>> source = openBytes(path, { firstBytes, 0 });
  if (!source)
  {
    return source.error();
  }
  tree->source = std::move(*source);
  const Result<std::string> page = read.size() > 1 ? textOf(read.back()) : std::string();
  if (!page)
  {
    return makeError(page.error().kind, page.error().what + "; the tree refers to it");
  }
  // The values of other trees are found by looking at all of them.
  const bool told =
    tree->description.encoding == EPTEncoding::Laszip && tree->description.points > 0;
  Result<EPTHierarchy> hierarchy = readEPTHierarchy(tree->place, told ? depth : EPTDepth::Whole,
    read.size() > 1 ? std::optional<std::string>(*page) : std::nullopt);
  if (!hierarchy)
  {
    return hierarchy.error();
  }
  tree->nodes = std::move(hierarchy->nodes);
  tree->pages = std::move(hierarchy->pages);
  if (isAddress(path) && !tree->nodes.empty())
  {
    Result<RawBytes> first = tree->readNode(tree->nodes.front());
    if (!first)
    {
      return first.error();
    }
    tree->first = std::move(*first);
  }
  return std::shared_ptr<const EPTFolder>(std::move(tree));
}

std::string EPTFolder::fileOf(const EPTNode& node) const
{
  const char* const ending = description.encoding == EPTEncoding::Laszip ? ".laz"
    : description.encoding == EPTEncoding::Binary                        ? ".bin"
                                                                         : ".zst";
  return beside(place, "ept-data/" + node.key + ending);
}

std::uint64_t EPTFolder::mostBytesOf(const EPTNode& node) const
{
  return mostBesidePoints + std::uint64_t(2) * node.points * description.recordBytes();
}

Result<RawBytes> EPTFolder::readNode(const EPTNode& node) const
{
  const ReadStop never{ false };
  return std::move(readNodes({ node }, never).front());
}

std::vector<Result<RawBytes>> EPTFolder::readNodes(
  const std::vector<EPTNode>& wanted, const ReadStop& stop) const
{
  const auto held = [this](const EPTNode& node)
  { return first.size > 0 && node.key == nodes.front().key; };
  std::vector<SmallFile> files;
  for (const EPTNode& node : wanted)
  {
    if (!held(node))
    {
      files.push_back({ fileOf(node), mostBytesOf(node) });
    }
  }
  std::vector<Result<RawBytes>> read = readSmallFiles(files, stop);
  std::vector<Result<RawBytes>> all;
  all.reserve(wanted.size());
  auto next = read.begin();
  for (const EPTNode& node : wanted)
  {
    if (!held(node))
    {
      all.push_back(std::move(*next++));
      continue;
    }
    RawBytes copy(first.size);
    std::copy_n(first.data.get(), first.size, copy.data.get());
    all.emplace_back(std::move(copy));
  }
  return all;
}

} // namespace pointfront
