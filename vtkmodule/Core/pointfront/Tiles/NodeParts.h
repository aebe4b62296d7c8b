#pragma once

#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Store/NodeReader.h"

#include <cstddef>
#include <cstdint>

namespace pointfront
{

/// Points `begin` to `end` of a node; no more memory than they take. `schema` is the node's own.
NodeColumns sliced(
  const NodeColumns& node, std::size_t begin, std::size_t end, const AttributeSchema& schema);

/// Which component of which column of the whole; of coordinates the axis alone.
struct WholeComponent
{
  std::uint32_t column = 0;
  std::uint32_t component = 0;
  const Attribute* attribute = nullptr; ///< null: a coordinate

  static WholeComponent of(std::uint32_t number, const AttributeSchema& schema);
};

/// Each open tile holds a file open: raises the limit of this process as far as it may be raised.
void raiseOpenFiles(std::size_t tiles);

} // namespace pointfront
