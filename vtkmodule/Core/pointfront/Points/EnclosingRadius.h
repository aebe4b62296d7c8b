#pragma once

#include "pointfront/Points/AttributeSchema.h"

namespace pointfront
{

/// Name of the column with the enclosing radius of representatives (Refinement::Replace): the
/// largest distance between a representative and a point that it stands for. float32, world units,
/// 0 for points of the input.
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
