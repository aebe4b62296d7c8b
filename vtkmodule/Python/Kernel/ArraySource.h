#pragma once

#include "pointfront/Points/ColumnSource.h"

namespace pointfront
{

/// Points whose positions and attributes lie in plain arrays of the caller, who keeps them.
class ArraySource final : public ColumnSource
{
public:
  /// `places`  three doubles for each of `points` points.
  ArraySource(const double* places, std::uint64_t points)
    : places_(places)
  {
    description_.path = "the arrays";
    description_.format = "NumPy arrays";
    description_.pointCount = points;
  }

  /// An attribute, `values` as many as there are points. False if there is one of that name.
  bool add(const Attribute& attribute, const void* values)
  {
    return addColumn(attribute, values, attribute.bytes());
  }

private:
  glm::dvec3 position(std::uint64_t point) const override
  {
    const double* const place = places_ + 3 * point;
    return { place[0], place[1], place[2] };
  }

  const double* places_;
};

} // namespace pointfront
