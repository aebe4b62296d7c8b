#pragma once

#include <string>

namespace pointfront
{

/// The path of a file that is kept for ever in Testing/Data: "version3.pfront".
std::string goldenFile(const std::string& name);

} // namespace pointfront
