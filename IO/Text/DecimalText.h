#pragma once

#include "pointfront/Points/ScalarType.h"

#include <cstddef>
#include <string>

namespace pointfront
{

/// Decimals after the point that tell apart all numbers offset + scale * integer.
/// As many as scale and offset have themselves when they are decimal numbers of at most 12 places;
/// else one more than the step's magnitude, an error of at most a twentieth of a step.
int decimalsOf(double scale, double offset);

/// Appends the number with exactly that many decimals.
void appendFixed(std::string& text, double value, int decimals);

/// Appends the component of that type that begins at `from`: integers as they are, floating point
/// as the shortest text that reads back to the same value.
void appendScalar(std::string& text, ScalarType type, const std::byte* from);

/// The same component as a number. Integers beyond 2^53 are rounded.
double scalarValue(ScalarType type, const std::byte* from);

} // namespace pointfront
