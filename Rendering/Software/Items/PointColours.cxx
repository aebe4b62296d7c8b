#include "PointColours.h"

#include "pointfront/Style/ClassHeights.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace pointfront
{
namespace
{

std::uint32_t packed(const Rgba8& rgba)
{
  const Rgba8 opaque{ rgba[0], rgba[1], rgba[2], 255 };
  std::uint32_t value;
  std::memcpy(&value, opaque.data(), 4);
  return value;
}

std::uint32_t packed(std::uint32_t red, std::uint32_t green, std::uint32_t blue)
{
  return packed(Rgba8{ static_cast<std::uint8_t>(red), static_cast<std::uint8_t>(green),
    static_cast<std::uint8_t>(blue), 255 });
}

template <typename T>
T load(const std::byte* bytes)
{
  T value;
  std::memcpy(&value, bytes, sizeof(T));
  return value;
}

bool ofFewBits(const PointColouring& colouring, const ColourMap* map, const AttributeSchema& schema)
{
  if (colouring.kind != PointColouring::Kind::Table || !colouring.usesColumn() || !map)
  {
    return false;
  }
  const Attribute& attribute = schema[colouring.column];
  const bool integer =
    attribute.type != ScalarType::Float32 && attribute.type != ScalarType::Float64;
  return integer && sizeOf(attribute.type) <= 2 && colouring.component >= 0;
}

} // namespace

ValueColours::ValueColours(
  const PointColouring& colouring, const ColourMap* map, const AttributeSchema& schema)
{
  if (!ofFewBits(colouring, map, schema))
  {
    return;
  }
  const Attribute& attribute = schema[colouring.column];
  Attribute one = attribute;
  one.components = 1;
  PointColouring first = colouring;
  first.component = 0;
  table_.resize(std::size_t(1) << (8 * sizeOf(attribute.type)));
  for (std::size_t bits = 0; bits < table_.size(); ++bits)
  {
    const auto stored = static_cast<std::uint16_t>(bits);
    std::byte bytes[2];
    std::memcpy(bytes, &stored, 2);
    table_[bits] = packed(map->at(first.valueOf(one, bytes)));
  }
}

struct PointColours::Flat
{
  static std::uint32_t read(const PointColours& c, std::uint32_t) { return c.flat_; }
};

/// Three components of 8 bits.
struct PointColours::Narrow
{
  static std::uint32_t read(const PointColours& c, std::uint32_t point)
  {
    const std::byte* const p = c.column_ + point * c.stride_;
    return packed(load<std::uint8_t>(p), load<std::uint8_t>(p + 1), load<std::uint8_t>(p + 2));
  }
};

/// Three of 16 bits that use them all.
struct PointColours::Wide
{
  static std::uint32_t read(const PointColours& c, std::uint32_t point)
  {
    const std::byte* const p = c.column_ + point * c.stride_;
    return packed(load<std::uint16_t>(p) >> 8, load<std::uint16_t>(p + 2) >> 8,
      load<std::uint16_t>(p + 4) >> 8);
  }
};

struct PointColours::Converted
{
  static std::uint32_t read(const PointColours& c, std::uint32_t point)
  {
    const std::byte* const p = c.column_ + point * c.stride_;
    const std::size_t width = sizeOf(c.attribute_->type);
    Rgba8 rgba{ 0, 0, 0, 255 };
    for (std::size_t i = 0; i < 3; ++i)
    {
      const double stored = visitScalar(c.attribute_->type,
        [&](auto zero) -> double
        { return static_cast<double>(load<decltype(zero)>(p + i * width)); });
      const double byte = stored * c.factor_ + c.offset_;
      rgba[i] = std::isnan(byte) ? std::uint8_t(0)
                                 : static_cast<std::uint8_t>(std::clamp(byte, 0.0, 255.0));
    }
    return packed(rgba);
  }
};

struct PointColours::Tabled8
{
  static std::uint32_t read(const PointColours& c, std::uint32_t point)
  {
    return c.table_[load<std::uint8_t>(c.column_ + point * c.stride_)];
  }
};

struct PointColours::Tabled16
{
  static std::uint32_t read(const PointColours& c, std::uint32_t point)
  {
    return c.table_[load<std::uint16_t>(c.column_ + point * c.stride_)];
  }
};

struct PointColours::Looked
{
  static std::uint32_t read(const PointColours& c, std::uint32_t point)
  {
    return packed(c.map_->at(c.valueAt(point)));
  }
};

struct PointColours::Combined
{
  static std::uint32_t read(const PointColours& c, std::uint32_t point)
  {
    const std::uint32_t colours[2] = { c.first_(c, point), c.second_->at(point) };
    Rgba8 both[2];
    std::memcpy(both, colours, sizeof(colours));
    return packed(combined(c.combination_, c.share256_, both[0], both[1]));
  }
};

double PointColours::valueAt(std::uint32_t point) const
{
  const PointColouring& colouring = colouring_;
  if (colouring.kind == PointColouring::Kind::Elevation)
  {
    const double steps =
      static_cast<double>(node_.origin.z) + static_cast<double>(node_.positions[point].z);
    return grid_.offset.z + grid_.scale.z * steps;
  }
  if (colouring.heights)
  {
    return colouring.heights->at(node_, point);
  }
  return colouring.valueOf(*attribute_, column_ + point * stride_);
}

template <typename Reading>
void PointColours::readBy()
{
  one_ = [](const PointColours& c, std::uint32_t point) { return Reading::read(c, point); };
  many_ = [](const PointColours& c, std::uint32_t first, int count, std::uint32_t* colours)
  {
    for (int i = 0; i < count; ++i)
    {
      colours[i] = Reading::read(c, first + static_cast<std::uint32_t>(i));
    }
  };
}

void PointColours::readColours(const Attribute& attribute)
{
  const bool plain = attribute.scale == 1.0 && attribute.offset == 0.0;
  if (plain && attribute.type == ScalarType::UInt8)
  {
    readBy<Narrow>();
    return;
  }
  if (plain && attribute.type == ScalarType::UInt16 && colouring_.wide)
  {
    readBy<Wide>();
    return;
  }
  const ColourScale scale(attribute, colouring_.wide, colouring_.colourRange);
  factor_ = scale.factor;
  offset_ = scale.offset;
  readBy<Converted>();
}

void PointColours::readValues(const Attribute& attribute)
{
  if (table_)
  {
    column_ += static_cast<std::size_t>(colouring_.component) * sizeOf(attribute.type);
    sizeOf(attribute.type) == 1 ? readBy<Tabled8>() : readBy<Tabled16>();
    return;
  }
  readBy<Looked>();
}

PointColours::PointColours(const FramePlan& plan, const ResolvedStyle& style,
  const StyleColours& tables, const NodeColumns& node)
  : PointColours(plan, style.colouring, style.map.get(), style.flat, tables.first, node)
{
  const SecondColour& second = style.second;
  if (second.combination == ColourCombination::None)
  {
    return;
  }
  second_.reset(
    new PointColours(plan, second.colouring, second.map.get(), second.flat, tables.second, node));
  combination_ = second.combination;
  share256_ = second.share256;
  first_ = one_;
  readBy<Combined>();
}

PointColours::PointColours(const FramePlan& plan, const PointColouring& colouring,
  const ColourMap* map, const Rgba8& flat, const ValueColours& table, const NodeColumns& node)
  : colouring_(colouring)
  , map_(map)
  , node_(node)
  , grid_(plan.grid)
  , flat_(packed(flat))
{
  const bool needsMap = colouring.usesTable();
  readBy<Flat>();
  if (colouring.kind == PointColouring::Kind::Flat || !colouring.coveredBy(node) ||
    (needsMap && !map))
  {
    return;
  }
  if (!colouring.usesColumn())
  {
    readBy<Looked>();
    return;
  }
  const auto place = std::find(node.selection.begin(), node.selection.end(), colouring.column);
  column_ = node.columns[static_cast<std::size_t>(place - node.selection.begin())].data();
  const Attribute& attribute = (*plan.schema)[colouring.column];
  attribute_ = &attribute;
  stride_ = attribute.bytes();
  if (needsMap)
  {
    table_ = table.empty() ? nullptr : table.data();
    readValues(attribute);
    return;
  }
  readColours(attribute);
}

} // namespace pointfront
