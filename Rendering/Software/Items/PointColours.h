#pragma once

#include "FetchAhead.h"

#include "pointfront/Plan/FramePlan.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// The colours that a style gives to values of few bits, made once for all points: an entry for
/// each stored number of an attribute of 8 or 16 bits.
/// Threads  a value; const functions from any thread.
class ValueColours
{
public:
  ValueColours(
    const PointColouring& colouring, const ColourMap* map, const AttributeSchema& schema);
  bool empty() const { return table_.empty(); }
  const std::uint32_t* data() const { return table_.data(); }

private:
  std::vector<std::uint32_t> table_; ///< by the stored bits
};

/// The tables of a style: of its colour, and of the second one that it is combined with.
struct StyleColours
{
  StyleColours(const ResolvedStyle& style, const AttributeSchema& schema)
    : first(style.colouring, style.map.get(), schema)
    , second(style.second.colouring, style.second.map.get(), schema)
  {
  }
  ValueColours first;
  ValueColours second;
};

/// The colouring of the points of one node: the place of their values and the way from values to
/// colours.
/// Shapes   colours are bytes r, g, b, a in memory order, a = 255.
/// Meaning  as referenceColours() of the tests; the flat colour where the node was read without the
///          column.
/// Threads  const functions from any thread; the node, the style and the table outlive it.
class PointColours
{
public:
  PointColours(const FramePlan& plan, const ResolvedStyle& style, const StyleColours& tables,
    const NodeColumns& node);

  /// Asks for the memory that holds a point's value.
  void fetchAhead(std::uint32_t point) const
  {
    if (column_)
    {
      __builtin_prefetch(column_ + point * stride_);
    }
  }
  /// The same for points one after the other.
  void fetchAhead(PointRange points) const
  {
    if (column_)
    {
      pointfront::fetchAhead(column_, stride_, points);
    }
  }
  std::uint32_t at(std::uint32_t point) const { return one_(*this, point); }
  /// Colours points [first, first + count).
  void fill(std::uint32_t first, int count, std::uint32_t* colours) const
  {
    many_(*this, first, count, colours);
  }

private:
  PointColours(const FramePlan& plan, const PointColouring& colouring, const ColourMap* map,
    const Rgba8& flat, const ValueColours& table, const NodeColumns& node);
  template <typename Reading>
  void readBy();
  void readColours(const Attribute& attribute);
  void readValues(const Attribute& attribute);
  double valueAt(std::uint32_t point) const;
  struct Flat;
  struct Narrow;
  struct Wide;
  struct Converted;
  struct Tabled8;
  struct Tabled16;
  struct Looked;
  struct Combined;

  std::uint32_t (*one_)(const PointColours&, std::uint32_t) = nullptr;
  void (*many_)(const PointColours&, std::uint32_t, int, std::uint32_t*) = nullptr;
  const PointColouring& colouring_;
  const ColourMap* map_;
  const NodeColumns& node_;
  const QuantisationGrid& grid_;
  const Attribute* attribute_ = nullptr;
  const std::byte* column_ = nullptr;
  const std::uint32_t* table_ = nullptr;
  std::size_t stride_ = 0;
  std::uint32_t flat_ = 0;
  double factor_ = 1.0; ///< from a stored component to 0..255
  double offset_ = 0.0;
  // Where two colours are combined:
  std::unique_ptr<PointColours> second_;
  std::uint32_t (*first_)(const PointColours&, std::uint32_t) = nullptr;
  ColourCombination combination_ = ColourCombination::None;
  std::uint32_t share256_ = 0;
};

} // namespace pointfront
