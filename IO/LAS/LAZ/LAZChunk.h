#pragma once

#include "LAZCompression.h"

#include <cstdint>

namespace pointfront
{

/// More points than this in one chunk are refused: a chunk is decompressed as a whole.
constexpr std::uint32_t lazMostChunkPoints = 1u << 24;

/// Points that are compressed together and can be decompressed without the others.
/// Shapes   the first point as it is, then either one arithmetic code (schemes Pointwise and
///          Chunked) or the number of points, the bytes of each layer, and the layers' codes.
struct LAZChunk
{
  std::uint64_t offset = 0; ///< byte in the file
  std::uint64_t bytes = 0;
  std::uint32_t points = 0;
  bool cut = false; ///< the file ends inside: `points` are sound, the bytes behind them unused
};

/// The layered chunk that begins at byte `offset`; zero points if what is there is no whole chunk
/// of at most `end - offset` bytes.
LAZChunk parseLayeredChunk(
  const LASFile& file, const LAZCompression& compression, std::uint64_t offset, std::uint64_t end);

/// The layered chunk that is all of these bytes, of records of `pointBytes`; zero points if they
/// are no whole chunk. Its offset is 0.
LAZChunk parseLayeredChunk(
  ByteSpan bytes, std::size_t pointBytes, const LAZCompression& compression);

/// False for a chunk with an arithmetic code that begins with four bytes of 255. No encoder
/// writes that (a code is less than its interval, 2^32 - 1), and LASzip's decoder, which does not
/// look, reads behind its tables.
bool codesCanBegin(const LASFile& file, const LAZCompression& compression, const LAZChunk& chunk);
/// The same of bytes that parseLayeredChunk() finds to be a chunk.
bool codesCanBegin(ByteSpan bytes, std::size_t pointBytes, const LAZCompression& compression);

} // namespace pointfront
