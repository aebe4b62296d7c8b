#pragma once

#include "pointfront/Points/NormalAttribute.h"

#include <glm/vec3.hpp>

#include <string>
#include <vector>

namespace pointfront
{

/// Estimates normals of the points of one node, from these points alone: what a cloud without
/// normals can have while its nodes load.
/// Threads  compute() from any thread.
class NodeNormals
{
public:
  virtual ~NodeNormals() = default;
  /// Their origin, for the user: "of planes through 16 points of the node".
  virtual std::string origin() const = 0;
  /// `normals[i]` is that of `positions[i]`, facing up; zero where there is none. Pure: the same
  /// positions, in any order, give the same normals.
  virtual void compute(
    const std::vector<glm::dvec3>& positions, std::vector<PackedNormal>& normals) const = 0;
};

} // namespace pointfront
