#pragma once

#include "pointfront/Front/LayerLimits.h"
#include "pointfront/Front/View.h"
#include "pointfront/Store/Hierarchy.h"

#include <vector>

namespace pointfront
{

/// About how many points of the overview lie in the frustum (N_OPIF), if every subtree shows the
/// share `shown` of its points. From the table alone: nodes wholly inside count wholly; one
/// that the frustum cuts is divided until it has few points of the overview, then measured at 64
/// places of its box. Rows that are coming are measured by their parent's box. Layers that are
/// hidden show none; those beyond the list are visible.
/// Source  Futterlieb, Teutsch & Berndt 2016, section 3.1.2 (SMOOTH-3).
double overviewInFrustum(const Hierarchy& hierarchy, const View& view, double shown,
  const std::vector<LayerLimits>& layers = {});

/// Share of a box that lies in the frustum, measured at 4 x 4 x 4 places: 0 to 1.
double shareInFrustum(const Bounds& box, const View& view);

} // namespace pointfront
