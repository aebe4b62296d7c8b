#pragma once

#include <string>
#include <vector>

namespace pointfront
{

/// Whether a store can be built of a file, by its ending; and it is there, and no surface.
bool isPointFile(const std::string& name);

/// Where the store of files is built if no other place is asked for: beside the first by name. Of
/// several files its name depends on all of their names, in any order.
std::string storePathBeside(std::vector<std::string> names);

} // namespace pointfront
