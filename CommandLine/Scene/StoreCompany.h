#pragma once

#include <string>
#include <vector>

namespace pointfront
{

/// What speaks against drawing these clouds together, full sentences: they name different
/// coordinate reference systems, or lie much farther apart than they are large. A cloud that does
/// not open is left to who draws it.
std::vector<std::string> doubtsOfCompany(const std::vector<std::string>& clouds);

} // namespace pointfront
