#pragma once

#include "LAZCompression.h"

#include "pointfront/Base/Result.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// Which layers of a layered chunk hold these columns: for LASzipReader::open().
std::uint32_t laszipLayers(const LASPointLayout& layout, const std::vector<std::uint32_t>& columns);
constexpr std::uint32_t laszipAllLayers = 0xFFFFFFFFu;

/// Decompresses one LAZ chunk through LASzip, point by point, into plain LAS records.
/// LASzip sees a file that is made up for it: a clean beginning, then the bytes of the chunk, then
/// the end. What else the real file claims cannot reach it.
/// Threads   one thread for each object; objects do not share anything.
class LASzipReader
{
public:
  /// `chunk` outlives the reader; its codesCanBegin(). Columns of other `layers` have any values.
  /// Errors   Unsupported with LASzip's own words.
  static Result<LASzipReader> open(const LASFile& file, const LAZCompression& compression,
    ByteSpan chunk, std::uint32_t points, std::uint32_t layers = laszipAllLayers);

  LASzipReader(LASzipReader&&) noexcept;
  LASzipReader& operator=(LASzipReader&&) noexcept;
  ~LASzipReader();

  /// Writes up to `count` records of the file's point size to `to`; gives how many there were
  /// before the bytes ended or contradicted the code.
  std::size_t read(std::size_t count, std::byte* to);
  /// Bytes of the chunk that LASzip has taken so far.
  std::size_t consumed() const;

private:
  struct Handle;
  explicit LASzipReader(std::unique_ptr<Handle> handle);
  std::unique_ptr<Handle> handle_;
};

} // namespace pointfront
