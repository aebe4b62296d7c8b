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

/// Columns that nodes are wanted with, by the layer they are of: buildings by normal and ground by
/// colour read normals of buildings and colours of the ground, nothing else.
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
  ColumnSelection others; ///< of layers beyond the list

  const ColumnSelection& of(std::uint16_t layer) const
  {
    return layer < layers.size() ? layers[layer] : others;
  }
  /// Of any layer, ascending.
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
  /// What the other wants as well.
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
