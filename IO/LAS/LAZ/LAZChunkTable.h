#pragma once

#include "LAZChunk.h"
#include "LAZCompression.h"

#include "pointfront/Base/Result.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

/// The chunks of a LAZ file in the order of their points, all inside the file, none empty.
/// Where   from the file's chunk table (COPC: chunks of any size). A file that lost its table (cut
///         short, or its writer was interrupted) is walked through instead, as is one of LASzip
///         before 2.0, which has none: layered chunks say how long they are, others are
///         decompressed once to find out. What is missing then is a warning with its count.
/// Errors  Truncated if points are claimed and not one is sound; BadFormat; Unsupported.
Result<std::vector<LAZChunk>> findLAZChunks(
  const LASFile& file, const LAZCompression& compression, std::vector<std::string>& warnings);

} // namespace pointfront
