#pragma once

#include "pointfront/Points/AttributeSchema.h"

#include <glm/vec3.hpp>

#include <cstddef>
#include <vector>

namespace pointfront
{

/// Some points on their way from a source: positions and one packed column for each attribute.
/// Shapes   positions[n], or steps[n] when they come from PointSource::readSteps(); columns[c]
///          holds n * schema[c].bytes() bytes, c as in the source's schema.
/// Reuse    a batch is made once a thread and filled again: resize() keeps the memory.
struct PointBatch
{
  std::vector<glm::dvec3> positions; ///< world coordinates in the source's CRS
  std::vector<glm::ivec3> steps; ///< instead: whole steps of the source's own grid
  std::vector<std::vector<std::byte>> columns;

  std::size_t size() const { return steps.empty() ? positions.size() : steps.size(); }
  void resize(std::size_t points, const AttributeSchema& schema)
  {
    steps.clear();
    positions.resize(points);
    resizeColumns(points, schema);
  }
  /// For points whose positions are given as steps.
  void resizeSteps(std::size_t points, const AttributeSchema& schema)
  {
    positions.clear();
    steps.resize(points);
    resizeColumns(points, schema);
  }
  /// Points of the same columns, positions given alike.
  void append(const PointBatch& more)
  {
    positions.insert(positions.end(), more.positions.begin(), more.positions.end());
    steps.insert(steps.end(), more.steps.begin(), more.steps.end());
    columns.resize(more.columns.size());
    for (std::size_t c = 0; c < columns.size(); ++c)
    {
      columns[c].insert(columns[c].end(), more.columns[c].begin(), more.columns[c].end());
    }
  }

private:
  void resizeColumns(std::size_t points, const AttributeSchema& schema)
  {
    columns.resize(schema.size());
    for (std::size_t c = 0; c < schema.size(); ++c)
    {
      columns[c].resize(points * schema[c].bytes());
    }
  }
};

} // namespace pointfront
