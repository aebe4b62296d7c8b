#pragma once

#include "pointfront/Picture/Picture.h"

#include <cstdint>
#include <functional>

namespace pointfront
{

/// How alike two pictures of one size are around each pixel: 1 the same, 0 nothing in common.
/// Formula  SSIM of the grey pictures (0.299 R + 0.587 G + 0.114 B), windows of 11 x 11 pixels with
///          Gaussian weights of sigma 1.5, K1 = 0.01, K2 = 0.03, range 255. At the border the
///          outermost pixels repeat.
/// Calls    `each` with a row of values, from the top row down; they are gone when it returns.
/// Memory   some 70 rows of doubles, whatever the height.
/// Source   Wang, Bovik, Sheikh & Simoncelli 2004, equation 13 and section III.C.
void structuralSimilarity(const Picture& one, const Picture& other,
  const std::function<void(std::uint32_t row, const double* values)>& each);

} // namespace pointfront
