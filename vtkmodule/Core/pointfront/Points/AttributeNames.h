#pragma once

#include "pointfront/Points/AttributeSchema.h"

#include <string>
#include <vector>

namespace pointfront
{

/// The names of the attributes, in the order of their columns.
std::vector<std::string> attributeNames(const AttributeSchema& schema);

/// The end of a message that no attribute has this name, or this name with a component: "; did you
/// mean 'intensity'?". The attributes that a style derives, such as "elevation", count as well.
/// Empty if no name is near.
std::string meantAttribute(const AttributeSchema& schema, const std::string& name);

} // namespace pointfront
