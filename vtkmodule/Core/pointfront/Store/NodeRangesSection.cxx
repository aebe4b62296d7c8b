#include "pointfront/Store/NodeRangesSection.h"

#include "pointfront/Codec/ByteStream.h"
#include "pointfront/Codec/Checksum.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>
#include <string>

namespace pointfront
{
namespace
{

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr std::size_t mostMarks = 256;
constexpr std::size_t markedGaps = 64;
/// Marks are chosen among the bounds of at most so many nodes.
constexpr std::size_t mostSampled = std::size_t(1) << 18;
/// Nodes whose codes have one checksum.
constexpr NodeIndex chunkNodes = 16384;
constexpr std::size_t entryBytes = 16;
constexpr std::uint32_t withoutCodes = 0;
constexpr std::uint32_t withCodes = 1;

constexpr ValueRange nothing{ infinity, -infinity };
constexpr NodeRanges::Codes codesOfNothing{ 1, 0, 1, 0 }; ///< those of putRangeCodes()

/// One in `step`, in no rhythm that the order of nodes could have.
bool isSampled(std::size_t node, std::size_t step)
{
  return (std::uint64_t(node) * 0x9e3779b97f4a7c15u >> 32) % step == 0;
}

ValueRange united(const ValueRange& a, const ValueRange& b)
{
  return { std::min(a.low, b.low), std::max(a.high, b.high) };
}

bool floatsHold(const Attribute& attribute)
{
  return attribute.type == ScalarType::Float32 || sizeOf(attribute.type) <= 2;
}

/// Both ends of the widest gaps between ascending values: strips of a flight are told apart to the
/// last bit, and points without a time from all others.
void addGapEnds(const std::vector<double>& bounds, std::set<double>& marks)
{
  std::vector<std::size_t> gaps(bounds.size() - 1);
  std::iota(gaps.begin(), gaps.end(), std::size_t(0));
  const auto wider = [&bounds](std::size_t a, std::size_t b)
  {
    const double widthA = bounds[a + 1] - bounds[a];
    const double widthB = bounds[b + 1] - bounds[b];
    return widthA != widthB ? widthA > widthB : a < b;
  };
  const auto end = gaps.begin() + static_cast<std::ptrdiff_t>(std::min(gaps.size(), markedGaps));
  std::partial_sort(gaps.begin(), end, gaps.end(), wider);
  for (auto gap = gaps.begin(); gap != end; ++gap)
  {
    marks.insert(bounds[*gap]);
    marks.insert(bounds[*gap + 1]);
  }
}

/// Values that ranges are rounded outwards to: all bounds of nodes where there are 256 at most,
/// else the ends of gaps and others with equally many values between, so that outliers take no more
/// than their share.
std::vector<double> chooseMarks(
  const std::vector<ValueRange>& own, const std::vector<NodeIndex>& filled)
{
  const std::size_t step = own.size() / mostSampled + 1;
  ValueRange all = nothing;
  std::vector<double> bounds;
  for (const NodeIndex i : filled)
  {
    if (!own[i].empty())
    {
      all = united(all, own[i]);
      if (isSampled(i, step))
      {
        bounds.push_back(own[i].low);
        bounds.push_back(own[i].high);
      }
    }
  }
  if (all.empty())
  {
    return {};
  }
  bounds.push_back(all.low);
  bounds.push_back(all.high);
  std::sort(bounds.begin(), bounds.end());
  bounds.erase(std::unique(bounds.begin(), bounds.end()), bounds.end());
  if (bounds.size() <= mostMarks)
  {
    return bounds;
  }
  std::set<double> marks{ bounds.front(), bounds.back() };
  addGapEnds(bounds, marks);
  const std::size_t left = mostMarks - marks.size();
  for (std::size_t mark = 1; mark <= left; ++mark)
  {
    marks.insert(bounds[mark * (bounds.size() - 1) / (left + 1)]);
  }
  return std::vector<double>(marks.begin(), marks.end());
}

void putChecksum(ByteWriter& out, std::size_t begin)
{
  out.put(checksumOf(out.bytes().data() + begin, out.size() - begin));
}

/// Marks with their checksum, then chunks of codes with theirs. True when there are codes.
bool putComponent(const std::vector<ValueRange>& own, const std::vector<ValueRange>& below,
  const std::vector<NodeIndex>& filled, const std::vector<double>& marks, ByteWriter& out)
{
  const std::size_t begin = out.size();
  out.putBytes(marks.data(), marks.size() * sizeof(double));
  putChecksum(out, begin);
  std::vector<NodeRanges::Codes> codes(own.size(), codesOfNothing);
  bool differ = filled.size() < own.size();
  for (const NodeIndex i : filled)
  {
    putRangeCodes(own[i], marks, &codes[i][0]);
    putRangeCodes(below[i], marks, &codes[i][2]);
    const auto last = static_cast<std::uint8_t>(marks.empty() ? 0 : marks.size() - 1);
    differ = differ || codes[i] != NodeRanges::Codes{ 0, last, 0, last };
  }
  if (marks.empty() || !differ)
  {
    return false;
  }
  for (std::size_t first = 0; first < codes.size(); first += chunkNodes)
  {
    const std::size_t chunk = out.size();
    const std::size_t count = std::min<std::size_t>(chunkNodes, codes.size() - first);
    out.putBytes(codes.data() + first, count * sizeof(NodeRanges::Codes));
    putChecksum(out, chunk);
  }
  return true;
}

std::uint64_t codesBytes(NodeIndex nodes)
{
  const std::uint64_t chunks = nodes / chunkNodes + (nodes % chunkNodes != 0 ? 1 : 0);
  return std::uint64_t(nodes) * sizeof(NodeRanges::Codes) + 4 * chunks;
}

} // namespace

void putRangeCodes(const ValueRange& range, const std::vector<double>& marks, std::uint8_t* codes)
{
  codes[0] = 1; // nothing: low after high
  codes[1] = 0;
  if (!range.empty())
  {
    const auto above = std::upper_bound(marks.begin(), marks.end(), range.low);
    const auto enough = std::lower_bound(marks.begin(), marks.end(), range.high);
    codes[0] = static_cast<std::uint8_t>(above - marks.begin() - 1);
    codes[1] = static_cast<std::uint8_t>(enough - marks.begin());
  }
}

void NodeRangesWriter::Values::add(const ValueRange& range)
{
  if (narrow)
  {
    floats.push_back(static_cast<float>(range.low));
    floats.push_back(static_cast<float>(range.high));
    return;
  }
  doubles.push_back(range.low);
  doubles.push_back(range.high);
}

ValueRange NodeRangesWriter::Values::at(std::uint32_t payload) const
{
  const std::size_t at = 2 * std::size_t(payload);
  return narrow ? ValueRange{ floats[at], floats[at + 1] }
                : ValueRange{ doubles[at], doubles[at + 1] };
}

NodeRangesWriter::NodeRangesWriter(const AttributeSchema& schema)
  : components_(rangeComponents(schema))
{
  std::size_t next = coordinateComponents;
  for (const Attribute& attribute : schema)
  {
    for (std::size_t c = 0; c < attribute.components; ++c)
    {
      components_[next++].narrow = floatsHold(attribute);
    }
  }
}

void NodeRangesWriter::add(const GridBounds& bounds, const std::vector<ColumnRange>& ranges)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    components_[static_cast<std::size_t>(axis)].add(bounds.empty()
        ? nothing
        : ValueRange{
            static_cast<double>(bounds.low[axis]), static_cast<double>(bounds.high[axis]) });
  }
  bool filled = !bounds.empty();
  std::size_t next = coordinateComponents;
  for (const ColumnRange& column : ranges)
  {
    for (const std::array<double, 2>& range : column.components)
    {
      components_[next++].add({ range[0], range[1] });
      filled = filled || range[0] <= range[1];
    }
  }
  filled_.push_back(filled);
}

/// Nodes that have ranges, or one below them that has, ascending.
std::vector<NodeIndex> NodeRangesWriter::filledNodes(
  const std::vector<Node>& nodes, const std::vector<std::uint32_t>& payloads) const
{
  std::vector<bool> marked(nodes.size());
  for (std::size_t i = nodes.size(); i-- > 0;) // parents come before their children
  {
    marked[i] = marked[i] || filled_[payloads[i]];
    if (marked[i] && nodes[i].parent != noNode)
    {
      marked[nodes[i].parent] = true;
    }
  }
  std::vector<NodeIndex> filled;
  for (NodeIndex i = 0; i < nodes.size(); ++i)
  {
    if (marked[i])
    {
      filled.push_back(i);
    }
  }
  return filled;
}

std::vector<std::byte> NodeRangesWriter::encode(
  const std::vector<Node>& nodes, const std::vector<std::uint32_t>& payloads) const
{
  ByteWriter directory;
  ByteWriter parts;
  const std::size_t begin = components_.size() * entryBytes + 4;
  std::vector<ValueRange> own(nodes.size(), nothing);
  std::vector<ValueRange> below(nodes.size(), nothing);
  const std::vector<NodeIndex> filled = filledNodes(nodes, payloads);
  for (const Values& values : components_)
  {
    for (const NodeIndex i : filled)
    {
      below[i] = own[i] = values.at(payloads[i]);
    }
    for (auto i = filled.rbegin(); i != filled.rend(); ++i) // parents come before their children
    {
      if (const NodeIndex parent = nodes[*i].parent; parent != noNode)
      {
        below[parent] = united(below[parent], below[*i]);
      }
    }
    const std::vector<double> marks = chooseMarks(own, filled);
    directory.put(std::uint64_t(begin + parts.size()));
    directory.put(static_cast<std::uint32_t>(marks.size()));
    directory.put(putComponent(own, below, filled, marks, parts) ? withCodes : withoutCodes);
  }
  putChecksum(directory, 0);
  directory.putBytes(parts.bytes().data(), parts.size());
  return directory.take();
}

struct NodeRangesFile::Part
{
  std::uint64_t offset = 0; ///< in the file
  std::uint32_t marks = 0;
  bool codes = false;
};

Result<NodeRangesFile::Part> NodeRangesFile::find(std::uint32_t component) const
{
  const std::size_t size = components_ * entryBytes + 4;
  const auto damaged = [this](const char* what)
  { return corruptStore(file_->path(), section_.offset, std::string("node ranges: ") + what); };
  if (section_.bytes < size)
  {
    return damaged("the section is too short");
  }
  std::vector<std::byte> bytes(size);
  if (Result<void> done = file_->readAt(section_.offset, bytes.data(), size); !done)
  {
    return done.error();
  }
  ByteReader checksum(bytes.data() + size - 4, 4);
  if (!matchesChecksum(bytes.data(), size - 4, checksum.get<std::uint32_t>()))
  {
    return damaged("the directory's checksum does not match");
  }
  ByteReader in(bytes.data() + component * entryBytes, entryBytes);
  Part part;
  const auto at = in.get<std::uint64_t>();
  part.marks = in.get<std::uint32_t>();
  const auto form = in.get<std::uint32_t>();
  part.codes = form == withCodes;
  const std::uint64_t needed =
    std::uint64_t(part.marks) * sizeof(double) + 4 + (part.codes ? codesBytes(nodes_) : 0);
  if (part.marks > mostMarks || form > withCodes || at > section_.bytes ||
    needed > section_.bytes - at)
  {
    return damaged("a part lies outside the section");
  }
  part.offset = section_.offset + at;
  return part;
}

Result<std::shared_ptr<const NodeRanges>> NodeRangesFile::read(
  std::uint32_t component, NodeIndex most) const
{
  const Result<Part> part = find(component);
  if (!part)
  {
    return part.error();
  }
  std::uint64_t at = part->offset;
  const auto readChecked = [&](void* target, std::size_t size) -> Result<void>
  {
    std::vector<std::byte> bytes(size + 4);
    if (Result<void> done = file_->readAt(at, bytes.data(), bytes.size()); !done)
    {
      return done;
    }
    ByteReader checksum(bytes.data() + size, 4);
    if (!matchesChecksum(bytes.data(), size, checksum.get<std::uint32_t>()))
    {
      return corruptStore(file_->path(), at, "node ranges: a checksum does not match");
    }
    std::copy_n(bytes.data(), size, static_cast<std::byte*>(target));
    at += bytes.size();
    return {};
  };
  std::vector<double> marks(part->marks);
  if (Result<void> done = readChecked(marks.data(), marks.size() * sizeof(double)); !done)
  {
    return done.error();
  }
  const bool ascending = std::is_sorted(marks.begin(), marks.end());
  std::vector<NodeRanges::Codes> codes;
  NodeIndex known = part->codes ? 0 : nodes_;
  while (part->codes && known < nodes_ && known < most)
  {
    const NodeIndex count = std::min(chunkNodes, nodes_ - known);
    codes.resize(std::size_t(known) + count);
    if (Result<void> done = readChecked(codes.data() + known, count * sizeof(NodeRanges::Codes));
        !done)
    {
      return done.error();
    }
    known += count;
  }
  const bool sound = std::all_of(codes.begin(), codes.end(),
    [&marks](const NodeRanges::Codes& c)
    { return (c[0] > c[1] || c[1] < marks.size()) && (c[2] > c[3] || c[3] < marks.size()); });
  if (!sound || !ascending)
  {
    return corruptStore(file_->path(), part->offset, "node ranges: a code has no mark");
  }
  return std::make_shared<const NodeRanges>(known, std::move(marks), std::move(codes));
}

} // namespace pointfront
