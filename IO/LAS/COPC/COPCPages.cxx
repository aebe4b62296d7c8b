#include "COPCPages.h"

#include "LASBytes.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace pointfront
{
namespace
{
constexpr std::size_t entryBytes = 32;
constexpr std::size_t entriesOfOnePage = 2048; ///< a whole hierarchy of up to so many is not cut
constexpr int levelsOfPage = 5;
constexpr std::size_t entriesWithin = 32; ///< trees of up to so many nodes stay in their page

using Cell = std::tuple<int, unsigned, unsigned, unsigned>;

/// One entry; a page's points are -1.
struct Entry
{
  const COPCNode* node = nullptr;
  bool page = false;
};

struct Pages
{
  const std::vector<COPCNode>& nodes; ///< by level, then by cell
  std::map<Cell, std::size_t> cells;
  std::vector<std::size_t> below; ///< nodes of the tree that begins at a node, itself too

  static Cell cellOf(const COPCNode& node)
  {
    return { node.level, node.cell.x, node.cell.y, node.cell.z };
  }

  explicit Pages(const std::vector<COPCNode>& sorted)
    : nodes(sorted)
    , below(sorted.size(), 1)
  {
    for (std::size_t i = 0; i < nodes.size(); ++i)
    {
      cells[cellOf(nodes[i])] = i;
    }
    for (std::size_t i = nodes.size(); i-- > 1;)
    {
      const glm::uvec3 up = nodes[i].cell / 2u;
      below[cells.at({ nodes[i].level - 1, up.x, up.y, up.z })] += below[i];
    }
  }

  template <typename Each>
  void eachChild(const COPCNode& node, const Each& each) const
  {
    for (unsigned child = 0; child < 8; ++child)
    {
      const auto found = cells.find({ node.level + 1, 2 * node.cell.x + (child & 1),
        2 * node.cell.y + ((child >> 1) & 1), 2 * node.cell.z + (child >> 2) });
      if (found != cells.end())
      {
        each(found->second);
      }
    }
  }

  /// The entries of the page that begins at node `first`, parents before their children.
  std::vector<Entry> page(std::size_t first, bool whole) const
  {
    std::vector<Entry> entries{ { &nodes[first], false } };
    for (std::size_t i = 0; i < entries.size(); ++i)
    {
      const COPCNode& node = *entries[i].node;
      if (entries[i].page)
      {
        continue;
      }
      eachChild(node,
        [&](std::size_t child)
        {
          const bool cut = !whole && nodes[child].level - nodes[first].level >= levelsOfPage &&
            (nodes[child].level - nodes[first].level) % levelsOfPage == 0 &&
            below[child] > entriesWithin;
          entries.push_back({ &nodes[child], cut });
        });
    }
    return entries;
  }
};
} // namespace

COPCPages COPCPages::compose(std::vector<COPCNode> nodes, std::uint64_t offset)
{
  if (nodes.empty())
  {
    nodes.emplace_back();
  }
  std::sort(nodes.begin(), nodes.end(),
    [](const COPCNode& a, const COPCNode& b) { return Pages::cellOf(a) < Pages::cellOf(b); });
  const Pages tree(nodes);
  const bool whole = nodes.size() <= entriesOfOnePage;

  COPCPages result;
  std::vector<std::size_t> pending{ 0 }; // first nodes of pages
  std::vector<std::size_t> referredAt{ 0 }; // bytes of the entries that are to know their pages
  for (std::size_t p = 0; p < pending.size(); ++p)
  {
    const std::vector<Entry> entries = tree.page(pending[p], whole);
    const std::size_t begin = result.bytes.size();
    const std::size_t size = entries.size() * entryBytes;
    if (p == 0)
    {
      result.rootBytes = size;
    }
    else
    {
      storeNumber(result.bytes.data() + referredAt[p] + 16, offset + begin);
      storeNumber(result.bytes.data() + referredAt[p] + 24, static_cast<std::int32_t>(size));
    }
    result.bytes.resize(begin + size);
    std::byte* to = result.bytes.data() + begin;
    for (const Entry& entry : entries)
    {
      const COPCNode& node = *entry.node;
      storeNumber(to, static_cast<std::int32_t>(node.level));
      for (int axis = 0; axis < 3; ++axis)
      {
        storeNumber(to + 4 + 4 * axis, static_cast<std::int32_t>(node.cell[axis]));
      }
      storeNumber(to + 16, node.offset);
      storeNumber(to + 24, static_cast<std::int32_t>(node.bytes));
      storeNumber(
        to + 28, entry.page ? std::int32_t{ -1 } : static_cast<std::int32_t>(node.points));
      if (entry.page)
      {
        pending.push_back(tree.cells.at(Pages::cellOf(node)));
        referredAt.push_back(static_cast<std::size_t>(to - result.bytes.data()));
      }
      to += entryBytes;
    }
  }
  return result;
}

} // namespace pointfront
