#pragma once

#include "pointfront/Points/ColumnSource.h"
#include "pointfront/Table/PositionSurvey.h"

#include <memory>

namespace pointfront
{

/// Points whose positions and attributes lie in plain arrays of the caller, who keeps them.
class ArraySource final : public ColumnSource
{
public:
  /// Looks at all places, for bounds and a decimal grid.
  /// `places`  three doubles for each of `points` points.
  static Result<std::unique_ptr<ArraySource>> make(
    const double* places, std::uint64_t points, const SurveyOptions& options)
  {
    std::unique_ptr<ArraySource> source(new ArraySource(places, points));
    const Result<PositionExtent> extent = surveyPositions(*source, options);
    if (!extent)
    {
      return extent.error();
    }
    extent->describe(source->description_);
    return source;
  }

  /// An attribute, `values` as many as there are points. False if there is one of that name.
  bool add(const Attribute& attribute, const void* values)
  {
    return addColumn(attribute, values, attribute.bytes());
  }

private:
  ArraySource(const double* places, std::uint64_t points)
    : places_(places)
  {
    description_.path = "the arrays";
    description_.format = "NumPy arrays";
    description_.pointCount = points;
  }
  glm::dvec3 position(std::uint64_t point) const override
  {
    const double* const place = places_ + 3 * point;
    return { place[0], place[1], place[2] };
  }

  const double* places_;
};

} // namespace pointfront
