#include "pointfront/Codec/Checksum.h"
#include "pointfront/Store/NodePage.h"
#include "pointfront/Store/NodeTableSection.h"
#include "pointfront/Store/PagedNodeTable.h"
#include "pointfront/Store/StoreContent.h"

#include <array>
#include <new>
#include <string>
#include <utility>
#include <vector>

namespace pointfront
{
namespace
{
/// 256 KiB: a fiftieth of a second of a line of 100 Mbit/s.
constexpr std::size_t farPagesAtOnce = 64;

/// Pages of a store's file.
class NodePageFile final : public NodePageSource
{
public:
  NodePageFile(std::shared_ptr<const ByteSource> file, std::uint64_t offset, TableLimits limits,
    NodeRowForm form)
    : file_(std::move(file))
    , offset_(offset)
    , limits_(limits)
    , form_(form)
  {
  }
  NodeIndex nodeCount() const override { return limits_.nodes; }
  std::uint32_t pageRows() const override { return nodePageRowsOf(form_); }
  Result<void> read(std::uint32_t page, NodePage& rows) const override
  {
    std::array<std::byte, nodePageBytes> bytes;
    const Result<void> done = file_->readAt(offsetOf(page), bytes.data(), bytes.size());
    return done ? decode(page, bytes.data(), rows) : done;
  }
  std::size_t pagesAtOnce() const override { return file_->cost().far() ? farPagesAtOnce : 1; }
  std::vector<Result<void>> readAll(
    const std::vector<std::uint32_t>& pages, std::vector<NodePage>& rows) const override
  {
    std::vector<std::byte> bytes(pages.size() * nodePageBytes);
    std::vector<ByteRange> ranges;
    for (std::size_t p = 0; p < pages.size(); ++p)
    {
      ranges.push_back({ offsetOf(pages[p]), nodePageBytes, bytes.data() + p * nodePageBytes });
    }
    const Result<void> done = file_->read(ranges.data(), ranges.size());
    std::vector<Result<void>> results;
    for (std::size_t p = 0; p < pages.size(); ++p)
    {
      results.push_back(done ? decode(pages[p], ranges[p].target, rows[p]) : done);
    }
    return results;
  }

private:
  std::uint64_t offsetOf(std::uint32_t page) const
  {
    return offset_ + std::uint64_t(page) * nodePageBytes;
  }
  Result<void> decode(std::uint32_t page, const std::byte* bytes, NodePage& rows) const
  {
    const std::string fault = decodeNodePage(bytes, page, limits_, rows, form_);
    return fault.empty() ? Result<void>() : corruptStore(file_->path(), offsetOf(page), fault);
  }

  std::shared_ptr<const ByteSource> file_;
  std::uint64_t offset_;
  TableLimits limits_;
  NodeRowForm form_;
};

Result<std::shared_ptr<const Hierarchy>> readWhole(
  const ByteSource& file, const StoreFooter& footer, StoreDescription& description)
{
  const SectionEntry& section = *footer.find(SectionKind::NodeTable);
  std::vector<std::byte> bytes(static_cast<std::size_t>(section.bytes));
  if (Result<void> done = file.readAt(section.offset, bytes.data(), bytes.size()); !done)
  {
    return done.error();
  }
  if (!matchesChecksum(bytes.data(), bytes.size(), section.checksum))
  {
    return corruptStore(file.path(), section.offset, "the node table's checksum does not match");
  }
  std::vector<Node> nodes = decodeNodeTable(bytes.data(), footer.nodeCount, NodeRowForm::Plain);
  const std::string fault =
    nodeTableFault(nodes, description.layers.size(), footer.pointCount, description.refinement);
  if (!fault.empty())
  {
    return corruptStore(file.path(), section.offset, fault);
  }
  std::vector<NodeIndex> roots = rootsOf(nodes);
  auto table =
    std::make_shared<HierarchyTable>(std::move(nodes), std::move(roots), description.refinement);
  countLayers(*table, description);
  return std::shared_ptr<const Hierarchy>(std::move(table));
}

/// The fault between the roots, the layers and the footer.
std::string summaryFault(
  const Hierarchy& table, const StoreFooter& footer, const StoreDescription& description)
{
  std::uint64_t below = 0;
  for (const NodeIndex index : table.roots())
  {
    if (index >= footer.nodeCount)
    {
      return "the list of roots names a node outside the table";
    }
    const Node root = table.node(index);
    if (const std::optional<Error> damage = table.fault())
    {
      return damage->what;
    }
    if (root.parent != noNode)
    {
      return "node " + std::to_string(index) + " is in the list of roots and has a parent";
    }
    below += root.pointsBelow;
  }
  std::uint64_t points = 0;
  std::uint64_t nodes = 0;
  for (const Layer& layer : description.layers)
  {
    points += layer.pointCount;
    nodes += layer.nodeCount;
  }
  if (points != footer.pointCount || below != footer.pointCount)
  {
    return "the layers hold " + std::to_string(points) + " points, the roots " +
      std::to_string(below) + ", the store claims " + std::to_string(footer.pointCount);
  }
  return nodes == footer.nodeCount ? "" : "the layers' nodes do not add up";
}
} // namespace

std::vector<Result<void>> NodePageSource::readAll(
  const std::vector<std::uint32_t>& pages, std::vector<NodePage>& rows) const
{
  std::vector<Result<void>> done;
  for (std::size_t p = 0; p < pages.size(); ++p)
  {
    try
    {
      done.push_back(read(pages[p], rows[p]));
    }
    catch (const std::bad_alloc&)
    {
      done.push_back(makeError(Error::Kind::NoMemory, "no memory for a page of the node table"));
    }
  }
  return done;
}

Result<std::shared_ptr<const Hierarchy>> openNodeTable(
  const std::shared_ptr<const ByteSource>& file, std::uint32_t version, const StoreFooter& footer,
  StoredDescription& stored)
{
  const SectionEntry& section = *footer.find(SectionKind::NodeTable);
  const NodeRowForm form = version < 3 ? NodeRowForm::Plain : NodeRowForm::WithSplatRadius;
  const std::uint64_t expected = version == 1
    ? std::uint64_t(footer.nodeCount) * nodeRowBytes(form)
    : std::uint64_t(nodePageCount(footer.nodeCount, nodePageRowsOf(form))) * nodePageBytes;
  if (section.bytes != expected)
  {
    return corruptStore(file->path(), section.offset, "the node table's size is wrong");
  }
  if (version == 1)
  {
    return readWhole(*file, footer, stored.description);
  }
  const TableLimits limits{ footer.nodeCount,
    static_cast<std::uint32_t>(stored.description.layers.size()) };
  auto table = std::make_shared<PagedNodeTable>(
    std::make_unique<NodePageFile>(file, section.offset, limits, form), stored.roots,
    stored.description.refinement);
  const std::string fault = summaryFault(*table, footer, stored.description);
  if (const std::optional<Error> damage = table->fault())
  {
    return *damage;
  }
  if (!fault.empty())
  {
    return corruptStore(file->path(), section.offset, fault);
  }
  table->keepRoots();
  return std::shared_ptr<const Hierarchy>(std::move(table));
}

} // namespace pointfront
