#pragma once

#include "LASExport.h"

#include <string>
#include <vector>

namespace pointfront
{

/// Whether there surely are scan angles that are not whole degrees from -90 to 90: beyond point
/// formats 0 to 5. Only the smallest and the largest are known.
bool hasFineAngles(const SinkDescription& description);

/// Chooses for each column the field of its name, extra bytes, or both where the field holds some
/// values only. Fills `layout`, `origins` and `exactNames` of the plan, adds to `changes`; gives
/// the extra attributes.
std::vector<Attribute> chooseLASFields(
  const SinkDescription& description, int pointFormat, LASExport& plan);

/// Attributes that their fields do not hold as they are: full sentences.
std::vector<std::string> fieldFindings(const LASExport& plan, const LASTotals& totals);

} // namespace pointfront
