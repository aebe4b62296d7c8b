#pragma once

#include "pointfront/Base/MemoryMap.h"
#include "pointfront/Base/Result.h"

#include <string>

namespace pointfront
{

/// Text files as bytes of an encoding whose digits are ASCII: UTF-8, latin-1 and the like are
/// mapped as they are. What gzip packed, and UTF-16 (told by its mark, or by its zeros), is
/// unpacked to UTF-8 into a file without a name in `temporaryFolder` (empty: the system's).
/// Errors  of MemoryMap::open; Truncated, BadFormat: damaged gzip; Unwritable: no room to unpack.
Result<MemoryMap> mapText(const std::string& path, const std::string& temporaryFolder);

/// The beginning of such a text, whole lines of about 256 KiB, unpacked in memory. Empty if the
/// file cannot be read.
std::string beginningOfText(const std::string& path);

/// Bytes of the UTF-8 mark at the beginning: 3 or 0.
std::size_t markBytes(std::string_view text);
/// Text that is no UTF-8 is taken for latin-1.
std::string toUtf8(const std::string& text);

} // namespace pointfront
