#pragma once

#include <string>
#include <vector>

namespace pointfront
{

/// Reasons against drawing these clouds together, in full sentences: they name different
/// coordinate reference systems, or lie much farther apart than they are large. A cloud that does
/// not open is left to who draws it.
std::vector<std::string> doubtsOfCompany(const std::vector<std::string>& clouds);

} // namespace pointfront
