#pragma once

#include "pointfront/Style/PointFilter.h"

namespace pointfront
{

/// A condition's numbers as the doubles that its points are compared as, where a number is written
/// as info and exports write a value: the double of 9983 steps of 0.0001 is not that of 0.9983, and
/// that of the float 8.604 is not that of 8.604. All other numbers stay.
/// `attribute`  has the values; unset for a condition on a coordinate.
void takeAsWritten(AttributeCondition& condition, const Attribute* attribute);

} // namespace pointfront
