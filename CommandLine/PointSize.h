#pragma once

#include "pointfront/Front/View.h"
#include "pointfront/Store/Hierarchy.h"

namespace pointfront
{

/// The diameter in whole pixels at which neighbouring points just close the surface: one and a
/// half times their projected spacing, which is `errorPx` where the front can still refine and
/// the leaves' own where it cannot. The median over the visible points; 1 to 16.
double closingPointSize(const Hierarchy& hierarchy, const View& view, double errorPx);

} // namespace pointfront
