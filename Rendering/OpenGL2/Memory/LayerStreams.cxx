#include "LayerStreams.h"

#include "PointColours.h"
#include "ShapeCode.h"

#include <algorithm>
#include <cstring>
#include <utility>

namespace pointfront
{
namespace
{

/// Alpha of a point that no style draws.
constexpr std::uint32_t hiddenMark = 255;

bool covers(const NodeColumns& node, const ColumnSelection& columns)
{
  return std::includes(
    node.selection.begin(), node.selection.end(), columns.begin(), columns.end());
}

const std::byte* columnOf(const NodeColumns& node, const std::optional<std::uint32_t>& column)
{
  const auto place = column ? std::find(node.selection.begin(), node.selection.end(), *column)
                            : node.selection.end();
  return place == node.selection.end()
    ? nullptr
    : node.columns[static_cast<std::size_t>(place - node.selection.begin())].data();
}

bool sameMap(const std::shared_ptr<const ColourMap>& a, const std::shared_ptr<const ColourMap>& b)
{
  return a == b || (a && b && *a == *b);
}

/// The same colours of the same points.
bool coloursAs(const ResolvedStyle& a, const ResolvedStyle& b)
{
  return a.colouring == b.colouring && sameMap(a.map, b.map) && a.flat == b.flat &&
    a.second == b.second && a.filter == b.filter;
}

/// The columns that a marked layer's colours are made of.
ColumnSelection markedColumns(const LayerStreams::Styles& styles)
{
  ColumnSelection all;
  for (const auto& style : styles)
  {
    for (const ColumnSelection& some :
      { style->colouring.columns(), style->filter.columns(),
        style->second.combination == ColourCombination::None ? ColumnSelection()
                                                             : style->second.colouring.columns() })
    {
      all.insert(all.end(), some.begin(), some.end());
    }
  }
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

glm::vec3 normalAt(const std::byte* column, const Attribute& attribute, std::uint32_t point)
{
  const std::byte* const bytes = column + std::size_t(point) * attribute.bytes();
  return visitScalar(attribute.type,
    [&](auto zero)
    {
      decltype(zero) xyz[3];
      std::memcpy(xyz, bytes, sizeof(xyz));
      return glm::vec3(xyz[0], xyz[1], xyz[2]);
    });
}

/// Above 0, store units; 0 for one that is none.
void encodeLengths(const std::byte* column, const Attribute& attribute, std::uint32_t first,
  std::uint32_t count, std::vector<std::uint32_t>& values)
{
  visitScalar(attribute.type,
    [&](auto zero)
    {
      for (std::uint32_t point = first; point < first + count; ++point)
      {
        decltype(zero) stored;
        std::memcpy(&stored, column + std::size_t(point) * attribute.bytes(), sizeof(stored));
        const double length = static_cast<double>(stored) * attribute.scale + attribute.offset;
        const float value = length > 0.0 ? static_cast<float>(length) : 0.0f;
        std::uint32_t bits;
        std::memcpy(&bits, &value, sizeof(bits));
        values.push_back(bits);
      }
    });
}

/// Final colours, and in alpha the number of the style that draws the point.
void encodeMarked(const LayerStreams::Styles& styles, const FramePlan& plan,
  const NodeColumns& node, std::uint32_t first, std::uint32_t count,
  std::vector<std::uint32_t>& values)
{
  const std::size_t begin = values.size();
  values.resize(begin + count, hiddenMark << 24);
  std::vector<std::uint8_t> keep(count);
  std::vector<std::uint32_t> colours(count);
  for (std::size_t number = 0; number < styles.size(); ++number)
  {
    const ResolvedStyle& style = *styles[number];
    std::fill(keep.begin(), keep.end(), std::uint8_t(1));
    if (!style.filter.empty())
    {
      style.filter.evaluate(node, *plan.schema, first, count, keep.data());
    }
    const StyleColours tables(style, *plan.schema);
    PointColours(plan, style, tables, node).fill(first, static_cast<int>(count), colours.data());
    for (std::uint32_t i = 0; i < count; ++i)
    {
      const std::uint32_t marked =
        (colours[i] & 0xffffffu) | static_cast<std::uint32_t>(number) << 24;
      values[begin + i] = keep[i] != 0 ? marked : values[begin + i];
    }
  }
}

} // namespace

LayerStreams::LayerStreams(Styles styles)
  : streams_(GpuStreams::of(styles))
{
  for (const auto& style : styles)
  {
    if (style->lens >= static_cast<int>(gpuLenses))
    {
      continue;
    }
    sets_[valueSetOf(*style)].push_back(style);
    normal_ = normal_ ? normal_ : style->normalColumn;
    radius_ = radius_ ? radius_ : style->radiusColumn;
    if (style->size.mode == SplatSize::Mode::Attribute)
    {
      size_ = style->size.column;
    }
    height_ = height_ ? height_ : style->heightColumn;
  }
}

bool LayerStreams::canDraw(const Styles& styles)
{
  std::optional<std::uint32_t> size;
  bool one = styles.size() < hiddenMark;
  for (const auto& style : styles)
  {
    one = one && style->lens < static_cast<int>(gpuLenses);
    if (style->size.mode == SplatSize::Mode::Attribute)
    {
      one = one && (!size || *size == style->size.column);
      size = style->size.column;
    }
  }
  return one;
}

int LayerStreams::markOf(const ResolvedStyle& style) const
{
  const std::size_t set = valueSetOf(style);
  const Styles& styles = sets_[set];
  const auto place = std::find_if(
    styles.begin(), styles.end(), [&](const auto& each) { return each.get() == &style; });
  return streams_.marked[set] ? static_cast<int>(place - styles.begin()) : -1;
}

const LayerStreams::Styles& LayerStreams::stylesOf(GpuStream stream) const
{
  const auto number = static_cast<std::size_t>(stream);
  const auto lenses = static_cast<std::size_t>(GpuStream::Lenses);
  return sets_[stream == GpuStream::Value ? 0 : number - lenses + 1];
}

bool LayerStreams::fillsAs(const LayerStreams& other, GpuStream stream) const
{
  if (has(stream) != other.has(stream))
  {
    return false;
  }
  switch (stream)
  {
    case GpuStream::Shape:
      return normal_ == other.normal_ && radius_ == other.radius_;
    case GpuStream::Size:
      return size_ == other.size_;
    case GpuStream::Height:
      return height_ == other.height_;
    default:
      break;
  }
  const Styles& mine = stylesOf(stream);
  const Styles& others = other.stylesOf(stream);
  if (mine.empty() || others.empty())
  {
    return mine.empty() && others.empty();
  }
  const std::size_t set = valueSetOf(*mine.front());
  if (!streams_.marked[set] && !other.streams_.marked[set])
  {
    return mine.front()->colouring == others.front()->colouring;
  }
  return streams_.marked[set] == other.streams_.marked[set] &&
    std::equal(mine.begin(), mine.end(), others.begin(), others.end(),
      [](const auto& a, const auto& b) { return coloursAs(*a, *b); });
}

bool LayerStreams::coveredBy(const NodeColumns& node, GpuStream stream) const
{
  switch (stream)
  {
    case GpuStream::Shape:
      return (!normal_ || columnOf(node, normal_)) && (!radius_ || columnOf(node, radius_));
    case GpuStream::Size:
      return columnOf(node, size_) != nullptr;
    case GpuStream::Height:
      return columnOf(node, height_) != nullptr;
    default:
    {
      const Styles& styles = stylesOf(stream);
      return streams_.marked[valueSetOf(*styles.front())]
        ? covers(node, markedColumns(styles))
        : styles.front()->colouring.coveredBy(node);
    }
  }
}

void LayerStreams::encode(GpuStream stream, const FramePlan& plan, const NodeColumns& node,
  std::uint32_t first, std::uint32_t count, std::vector<std::uint32_t>& values) const
{
  switch (stream)
  {
    case GpuStream::Shape:
      encodeShapes(plan, node, first, count, values);
      break;
    case GpuStream::Size:
      encodeLengths(columnOf(node, size_), (*plan.schema)[*size_], first, count, values);
      break;
    case GpuStream::Height:
      encodeLengths(columnOf(node, height_), (*plan.schema)[*height_], first, count, values);
      break;
    default:
    {
      const Styles& styles = stylesOf(stream);
      streams_.marked[valueSetOf(*styles.front())]
        ? encodeMarked(styles, plan, node, first, count, values)
        : styles.front()->colouring.encode(node, *plan.schema, first, count, values);
      break;
    }
  }
}

void LayerStreams::encodeShapes(const FramePlan& plan, const NodeColumns& node, std::uint32_t first,
  std::uint32_t count, std::vector<std::uint32_t>& values) const
{
  const std::byte* const normals = columnOf(node, normal_);
  const std::byte* const radii = columnOf(node, radius_);
  for (std::uint32_t point = first; point < first + count; ++point)
  {
    const glm::vec3 normal =
      normals ? normalAt(normals, (*plan.schema)[*normal_], point) : glm::vec3(0.0f);
    values.push_back(shapeCode::of(normal, radii ? std::uint8_t(radii[point]) : std::uint8_t(0)));
  }
}

} // namespace pointfront
