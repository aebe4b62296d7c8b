#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Points/PointSource.h"

#include <cstdint>
#include <string>

namespace pointfront
{

/// Tells whether an input has to be read again: sizes, checksums of the ends and times of
/// change of all files that it consists of. A file whose time alone has changed is read again, and
/// its points are then found to be the same.
/// Errors  those of reading the files.
Result<std::string> identityOfInput(const SourceDescription& description);
/// The same for one file, or for the folder of an EPT.
Result<std::string> identityOfFile(const std::string& path);

/// A text that is equal for sources of the same attributes, grid and coordinate reference system.
std::string kindOf(const SourceDescription& description);

/// A hash of text; `seed`: the hash of what came before.
std::uint64_t hashOfText(const std::string& text, std::uint64_t seed = 0);

} // namespace pointfront
