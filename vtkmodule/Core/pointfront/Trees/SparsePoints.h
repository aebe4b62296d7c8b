#pragma once

#include "pointfront/Records/RecordLayout.h"

#include <cstdint>
#include <vector>

namespace pointfront
{

/// The spacing that points in Morton order need where they are unevenly dense, in tree steps; 0:
/// all are in one place.
/// Need     A prefix takes the same share of the dense part as of the sparse one. Of a share
///          (s / t)^2 the sparse part, S apart, is S t / s apart: at most 2 t if s is at least
///          half of S. A spacing of the whole, sqrt(area / places), may be far below that: a
///          scanner on a tripod has nearly all points around its feet.
/// Measure  the side of cells in which one place of fifty is alone. Of even points, regular or
///          random ones, on a surface or in a volume, .4 of that side is their spacing and a
///          seventh more at most, so even points keep theirs. Cells of 2^n steps are runs of the
///          curve; between two sizes the share is taken as linear.
/// Cost     one pass, whole numbers and a division: the same on every machine.
double sparseSpacing(const RecordSpan& positions, const std::vector<std::uint32_t>& points);

} // namespace pointfront
