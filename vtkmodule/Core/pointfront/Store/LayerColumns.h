#pragma once

#include "pointfront/Store/NodeReader.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <utility>
#include <vector>

namespace pointfront
{

/// The columns that are wanted for the nodes of each layer. With buildings drawn by normal and
/// ground by colour, the normals of buildings and the colours of the ground are read and nothing
/// else.
/// Threads  a value.
struct LayerColumns
{
  LayerColumns() = default;
  /// The same for all layers.
  LayerColumns(ColumnSelection columns)
    : others(std::move(columns))
  {
  }

  std::vector<ColumnSelection> layers; ///< by number of the layer
  ColumnSelection others; ///< columns of layers beyond the list

  const ColumnSelection& of(std::uint16_t layer) const
  {
    return layer < layers.size() ? layers[layer] : others;
  }
  /// The columns of all layers together, ascending.
  ColumnSelection any() const
  {
    ColumnSelection all = others;
    for (const ColumnSelection& columns : layers)
    {
      unite(all, columns);
    }
    return all;
  }
  bool empty() const { return any().empty(); }
  /// Adds the columns of another object.
  void add(const LayerColumns& other)
  {
    const std::size_t count = std::max(layers.size(), other.layers.size());
    layers.resize(count, others);
    for (std::size_t layer = 0; layer < count; ++layer)
    {
      unite(layers[layer], other.of(static_cast<std::uint16_t>(layer)));
    }
    unite(others, other.others);
  }

  friend bool operator==(const LayerColumns& a, const LayerColumns& b)
  {
    return a.layers == b.layers && a.others == b.others;
  }
  friend bool operator!=(const LayerColumns& a, const LayerColumns& b) { return !(a == b); }

private:
  static void unite(ColumnSelection& all, const ColumnSelection& more)
  {
    ColumnSelection both;
    std::set_union(all.begin(), all.end(), more.begin(), more.end(), std::back_inserter(both));
    all = std::move(both);
  }
};

} // namespace pointfront
