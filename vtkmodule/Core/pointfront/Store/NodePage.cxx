#include "pointfront/Store/NodePage.h"

#include "pointfront/Codec/ByteStream.h"
#include "pointfront/Codec/Checksum.h"
#include "pointfront/Store/StoreFormat.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

namespace pointfront
{
namespace
{
constexpr std::size_t checksumAt = nodePageBytes - 4;
constexpr std::size_t firstPointAt = checksumAt - 8 - 4;

constexpr bool fits(NodeRowForm form)
{
  return nodePageRowsOf(form) * nodeRowBytes(form) <= firstPointAt;
}
static_assert(fits(NodeRowForm::Plain) && fits(NodeRowForm::WithSplatRadius));

bool notNegative(float value)
{
  return std::isfinite(value) && value >= 0.0f;
}

std::string sizeFault(const Node& row)
{
  const glm::dvec3& c = row.centre;
  if (!std::isfinite(c.x) || !std::isfinite(c.y) || !std::isfinite(c.z))
  {
    return "its centre is not a number";
  }
  const glm::vec3& h = row.halfSize;
  if (!notNegative(h.x) || !notNegative(h.y) || !notNegative(h.z) || !notNegative(row.radius) ||
    !notNegative(row.spacing) || !notNegative(row.splatRadius))
  {
    return "its size, radius, spacing or splat radius is not a positive number";
  }
  return {};
}

std::string childrenFault(const Node& row, NodeIndex index, NodeIndex nodes)
{
  if (row.leaf())
  {
    return row.firstChild == noNode ? "" : "it has no children but names a first child";
  }
  const bool inside =
    row.firstChild > index && row.firstChild < nodes && row.childCount <= nodes - row.firstChild;
  return inside ? "" : "its children lie outside the table";
}
} // namespace

std::string rowFault(const Node& row, NodeIndex index, const TableLimits& limits)
{
  if (std::string fault = sizeFault(row); !fault.empty())
  {
    return fault;
  }
  if (row.parent == noNode && row.level != 0)
  {
    return "it has no parent and is not at level 0";
  }
  if (row.parent != noNode && row.parent >= index)
  {
    return "its parent does not come before it";
  }
  if (row.parent != noNode && row.level == 0)
  {
    return "it has a parent and is at level 0";
  }
  if (std::string fault = childrenFault(row, index, limits.nodes); !fault.empty())
  {
    return fault;
  }
  if (row.pointCount > maxNodePoints)
  {
    return "it claims " + std::to_string(row.pointCount) + " points of its own, more than " +
      std::to_string(maxNodePoints);
  }
  return row.layer < limits.layers ? "" : "its layer is not in the list of layers";
}

void encodeNodePage(const Node* rows, std::uint32_t count, std::uint32_t page, std::byte* target)
{
  assert(count > 0 && count <= nodePageRows);
  ByteWriter out;
  out.reserve(nodePageBytes);
  for (std::uint32_t r = 0; r < count; ++r)
  {
    encodeNodeRow(rows[r], NodeRowForm::WithSplatRadius, out);
  }
  std::memset(target, 0, nodePageBytes);
  std::memcpy(target, out.bytes().data(), out.size());
  ByteWriter end;
  end.put(rows[0].firstPoint);
  end.put(page);
  std::memcpy(target + firstPointAt, end.bytes().data(), end.size());
  const std::uint32_t checksum = checksumOf(target, checksumAt);
  std::memcpy(target + checksumAt, &checksum, sizeof(checksum));
}

std::string decodeNodePage(const std::byte* data, std::uint32_t page, const TableLimits& limits,
  NodePage& rows, NodeRowForm form)
{
  const std::uint32_t count = nodePageLength(limits.nodes, page, nodePageRowsOf(form));
  const NodeIndex first = page * nodePageRowsOf(form);
  const std::string name = "node table, node " + std::to_string(first) + " to node " +
    std::to_string(first + count - 1) + ": ";
  ByteReader end(data + firstPointAt, 16);
  auto firstPoint = end.get<std::uint64_t>();
  const auto number = end.get<std::uint32_t>();
  if (!matchesChecksum(data, checksumAt, end.get<std::uint32_t>()))
  {
    return name + "the page's checksum does not match";
  }
  if (number != page)
  {
    return name + "the page is number " + std::to_string(number) + " instead of " +
      std::to_string(page);
  }
  ByteReader in(data, firstPointAt);
  for (std::uint32_t r = 0; r < count; ++r)
  {
    rows[r] = decodeNodeRow(form, in);
    rows[r].firstPoint = firstPoint;
    firstPoint += rows[r].pointCount;
    if (const std::string fault = rowFault(rows[r], first + r, limits); !fault.empty())
    {
      return "node " + std::to_string(first + r) + ": " + fault;
    }
  }
  return {};
}

std::vector<std::byte> encodeNodePages(const std::vector<Node>& nodes)
{
  const auto count = static_cast<NodeIndex>(nodes.size());
  std::vector<std::byte> bytes(std::size_t(nodePageCount(count)) * nodePageBytes);
  std::uint64_t firstPoint = 0;
  for (std::uint32_t page = 0; page < nodePageCount(count); ++page)
  {
    const std::uint32_t length = nodePageLength(count, page);
    const Node* rows = nodes.data() + std::size_t(page) * nodePageRows;
    NodePage numbered;
    std::copy(rows, rows + length, numbered.begin());
    numbered[0].firstPoint = firstPoint;
    encodeNodePage(numbered.data(), length, page, bytes.data() + std::size_t(page) * nodePageBytes);
    for (std::uint32_t r = 0; r < length; ++r)
    {
      firstPoint += rows[r].pointCount;
    }
  }
  return bytes;
}

} // namespace pointfront
