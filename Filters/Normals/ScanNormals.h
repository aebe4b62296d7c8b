#pragma once

#include "pointfront/Points/NormalAttribute.h"

#include <cstddef>
#include <vector>

namespace pointfront
{

/// Where each scan line begins among points in the order of a scan; the last entry is the number of
/// points. A line ends where the next point is far away (ten times the usual step), or where the
/// scanner's mirror turns back (three usual steps behind the farthest point).
std::vector<std::size_t> scanLines(const std::vector<glm::dvec3>& positions);

/// Normals from neighbours in the scan: of the triangle of the point, the nearer one of the points
/// before and after it in its scan line, and the nearest point of the lines before and after that
/// is not on a line with these two. Facing up; zero where there is no such triangle.
/// Source   EWA (Kovac 2009), section 3.2.
void scanNormals(const std::vector<glm::dvec3>& positions, std::vector<PackedNormal>& normals);

} // namespace pointfront
