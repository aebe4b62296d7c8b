#pragma once

#include "pointfront/Base/Result.h"

#include <cstddef>
#include <string>

namespace pointfront
{

/// Writes a file that is whole or absent: to a temporary name in the same folder, then renamed
/// over `path`. What was there before stays if it fails.
/// Errors  Unwritable, with the operating system's reason.
Result<void> writeWholeFile(const std::string& path, const void* bytes, std::size_t size);
Result<void> writeWholeFile(const std::string& path, const std::string& text);

/// False with the reason when a file of that name cannot be made: asked before hours of work.
Result<void> checkWritable(const std::string& path);

} // namespace pointfront
