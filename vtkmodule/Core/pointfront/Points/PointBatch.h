#pragma once

#include "pointfront/Points/AttributeSchema.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace pointfront
{

/// Some points on their way from a source: positions and one packed column for each attribute.
/// Shapes   positions[n]; columns[c] holds n * schema[c].bytes() bytes, c as in the source's
///          schema.
/// Reuse    a batch is made once a thread and filled again: resize() keeps the memory.
struct PointBatch
{
  std::vector<glm::dvec3> positions; ///< world coordinates in the source's CRS
  std::vector<std::vector<std::byte>> columns;

  std::size_t size() const { return positions.size(); }
  void resize(std::size_t points, const AttributeSchema& schema)
  {
    positions.resize(points);
    columns.resize(schema.size());
    for (std::size_t c = 0; c < schema.size(); ++c)
    {
      columns[c].resize(points * schema[c].bytes());
    }
  }
};

} // namespace pointfront
