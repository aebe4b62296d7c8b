#pragma once

#include <glm/vec2.hpp>

namespace pointfront
{

/// On which side of the line from `a` to `b` a point lies: 1 left, -1 right, 0 on it.
/// Exactness  the sign of the determinant of the doubles as they are, not of its rounded value, for
///            coordinates whose products neither overflow nor underflow (1e-140 to 1e140, and 0).
/// Source     Shewchuk 1997, "Adaptive Precision Floating-Point Arithmetic and Fast Robust
///            Geometric Predicates": the error bound of the quick test, expansions for the rest.
int orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p);

} // namespace pointfront
