#pragma once

#include "pointfront/Points/AttributeSchema.h"

namespace pointfront
{

/// Name of the column that tells how far the points that a representative stands for lie from it
/// (Refinement::Replace): float32, world units, 0 for points of the input.
constexpr const char* enclosingRadiusName = "enclosing_radius";

inline Attribute enclosingRadiusAttribute()
{
  Attribute radius;
  radius.name = enclosingRadiusName;
  radius.type = ScalarType::Float32;
  radius.description = "distance to the farthest point it stands for";
  return radius;
}

} // namespace pointfront
