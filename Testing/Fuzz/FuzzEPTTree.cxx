#include "BytesAsFile.h"
#include "EPTTree.h"
#include "LASFormat.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

namespace
{
namespace fs = std::filesystem;
constexpr std::string_view boundary = "\n----\n";

/// A folder as EPT wants one, whose nodes all have the same bytes. One for the whole run: only
/// contents change.
class TreeFolder
{
public:
  TreeFolder()
  {
    std::string name = (fs::temp_directory_path() / "fuzz-ept-XXXXXX").string();
    pointfront::fuzz::require(::mkdtemp(name.data()) != nullptr, "there is a temporary folder");
    folder_ = name;
    fs::create_directories(folder_ / "ept-hierarchy");
    fs::create_directories(folder_ / "ept-data");
    for (const char* key : { "0-0-0-0", "1-0-0-0", "1-1-1-1", "2-1-2-3" })
    {
      for (const char* ending : { ".laz", ".bin", ".zst" })
      {
        fs::create_symlink(folder_ / "node", folder_ / "ept-data" / (std::string(key) + ending));
      }
      // Pages below the first: the same text, which then names what was named already.
      if (std::string_view(key) != "0-0-0-0")
      {
        fs::create_symlink(folder_ / "ept-hierarchy" / "0-0-0-0.json",
          folder_ / "ept-hierarchy" / (std::string(key) + ".json"));
      }
    }
  }
  ~TreeFolder()
  {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  TreeFolder(const TreeFolder&) = delete;
  TreeFolder& operator=(const TreeFolder&) = delete;

  void write(std::string_view description, std::string_view page, std::string_view node) const
  {
    put("ept.json", description);
    put("ept-hierarchy/0-0-0-0.json", page);
    put("node", node);
  }
  std::string path() const { return folder_.string(); }

private:
  void put(const char* name, std::string_view text) const
  {
    std::ofstream file(folder_ / name, std::ios::binary | std::ios::trunc);
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
  }

  fs::path folder_;
};

std::string_view cutOff(std::string_view& text)
{
  const std::size_t end = std::min(text.find(boundary), text.size());
  const std::string_view part = text.substr(0, end);
  text.remove_prefix(std::min(text.size(), end + boundary.size()));
  return part;
}
} // namespace

/// A whole tree: description, page of the hierarchy and node, divided by lines "----". Whatever
/// they say, an Error or as many points as the hierarchy says.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  using namespace pointfront;
  static const TreeFolder folder;
  std::string_view text(reinterpret_cast<const char*>(data), size);
  const std::string_view description = cutOff(text);
  const std::string_view page = cutOff(text);
  folder.write(description, page, text);
  const auto openNode = &LASFormat::openBytes;
  const auto cloud = EPTTreeFormat(openNode).open(folder.path());
  if (!cloud)
  {
    fuzz::require(!cloud.error().what.empty(), "an Error says what happened");
    return 0;
  }
  const Hierarchy& table = *(*cloud)->hierarchy();
  ColumnSelection all;
  for (std::uint32_t c = 0; c < (*cloud)->description().schema.size(); ++c)
  {
    all.push_back(c);
  }
  constexpr NodeIndex most = 16;
  for (NodeIndex i = 0; i < table.nodeCount() && i < most; ++i)
  {
    const auto node = (*cloud)->read(i, all);
    if (!node)
    {
      fuzz::require(!node.error().what.empty(), "an Error says what happened");
      continue;
    }
    fuzz::require(node->size() == table.node(i).pointCount, "a node has its points");
    for (std::size_t c = 0; c < all.size(); ++c)
    {
      fuzz::require(
        node->columns[c].size() == node->size() * (*cloud)->description().schema[all[c]].bytes(),
        "columns are full");
    }
  }
  return 0;
}
