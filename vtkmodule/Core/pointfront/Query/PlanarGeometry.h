#pragma once

#include <glm/vec2.hpp>

#include <string>
#include <vector>

namespace pointfront
{

using PlanarLine = std::vector<glm::dvec2>;

/// Rings: the outer one and holes, in any order and sense; a last vertex may repeat the first.
struct PlanarPolygon
{
  std::vector<PlanarLine> rings;
};

/// Areas and lines on the map, as GIS programs write them (WKT, GeoJSON).
struct PlanarGeometry
{
  std::string crs; ///< system of its coordinates: "EPSG:25832" or a definition; empty: not said
  std::vector<PlanarPolygon> polygons;
  std::vector<PlanarLine> lines;
};

} // namespace pointfront
