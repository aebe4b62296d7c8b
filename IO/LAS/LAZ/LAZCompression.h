#pragma once

#include "LASBytes.h"
#include "LASFile.h"

#include "pointfront/Base/Result.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

/// How the points of a LAZ file are compressed: its "laszip encoded" record, checked against the
/// point format. LASzip is given nothing that did not pass here.
struct LAZCompression
{
  /// One part of a point that is compressed on its own.
  struct Item
  {
    std::uint16_t type = 0;
    std::uint16_t bytes = 0;
    std::uint16_t version = 0;
  };
  enum class Scheme : std::uint16_t
  {
    Pointwise = 1, ///< one run without chunks (LASzip before 2.0)
    Chunked = 2,
    Layered = 3 ///< chunks whose attributes lie one behind the other (formats 6 to 10)
  };
  static constexpr std::uint32_t variableChunks = 0xFFFFFFFFu;

  Scheme scheme = Scheme::Chunked;
  std::uint32_t chunkPoints = 0; ///< variableChunks: the chunk table says
  std::vector<Item> items;
  std::vector<std::byte> record; ///< the payload as it is in the file

  /// Number of layers of a chunk of scheme Layered.
  std::size_t layers() const;

  /// Errors   BadFormat, Unsupported, with the file's path.
  static Result<LAZCompression> of(const LASFile& file);
};

/// The beginning of a LAZ file that holds nothing but `points` points in one chunk: a header with
/// no claim of the original's, the compression record, and the place of a chunk table that is not
/// there. The bytes of that chunk follow it.
std::vector<std::byte> composeLAZBeginning(
  const LASFile& file, const LAZCompression& compression, std::uint32_t points);

} // namespace pointfront
