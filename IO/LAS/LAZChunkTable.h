#pragma once

#include "LAZCompression.h"

#include "pointfront/Base/Result.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

/// Points that are compressed together and can be decompressed without the others.
struct LAZChunk
{
  std::uint64_t offset = 0; ///< byte in the file
  std::uint64_t bytes = 0;
  std::uint32_t points = 0;
};

/// More points than this in one chunk are refused: a chunk is decompressed as a whole.
constexpr std::uint32_t lazMostChunkPoints = 1u << 24;

/// The chunks of a LAZ file in the order of their points, all inside the file, none empty.
/// Where   from the file's chunk table (COPC: chunks of any size). A file that lost its table (cut
///         short, or its writer was interrupted) is walked through instead, as is one of LASzip
///         before 2.0, which has none: layered chunks say how long they are, others are
///         decompressed once to find out. What is missing then is a warning with its count.
/// Errors  Truncated if points are claimed and not one is sound; BadFormat; Unsupported.
Result<std::vector<LAZChunk>> findLAZChunks(const LASFile& file,
  const LAZCompression& compression, std::vector<std::string>& warnings);

/// Points of a layered chunk that begins at byte `offset`, and its bytes; zero points if what is
/// there is no whole chunk of at most `end - offset` bytes.
LAZChunk parseLayeredChunk(const LASFile& file, const LAZCompression& compression,
  std::uint64_t offset, std::uint64_t end);

} // namespace pointfront
