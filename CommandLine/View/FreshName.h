#pragma once

#include <string>

namespace pointfront
{

/// The first of `stem`-1`extension`, `stem`-2`extension` and so on that names nothing yet.
std::string freshName(const std::string& stem, const std::string& extension);

} // namespace pointfront
