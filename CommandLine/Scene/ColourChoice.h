#pragma once

#include "ColourTable.h"

#include "pointfront/Base/Result.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Style/ColourSource.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// How the points of one picture get their colour.
struct ColourChoice
{
  std::string attribute; ///< an attribute of the store, or "elevation"
  bool direct = false; ///< rgb: the values are the colours
  bool vector = false; ///< normal: components over the range are the colours
  ColourTable table = {}; ///< else: from range[0] to range[1]
  std::array<double, 2> range{ 0.0, 1.0 }; ///< world units
};

/// Table and range for an attribute over all stores of a picture.
/// Names   an attribute's, "elevation", or what is made of others at run time: horizontality (of
///         normal), global-height (of elevation and layers); "-" stands for "_" too.
/// Range   2 % to 98 % of a sample of the points (StoreSample), so that a few outliers do not eat
///         the colours; the whole range when those are equal. normal: -1 to 1; horizontality and
///         global-height: 0 to 1. classification: one colour a code.
/// Errors  BadArgument: no store has the attribute, or it has several components (but rgb).
Result<ColourChoice> chooseColour(
  const std::string& attribute, const std::vector<std::shared_ptr<const StoredCloud>>& stores);

} // namespace pointfront
