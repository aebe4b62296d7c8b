#pragma once

#include "pointfront/Base/Result.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace pointfront
{

/// Writes a PNG picture row by row, so that a picture larger than memory can be written in bands.
/// Guarantees  the file is whole or absent: it gets its name in finish(); a writer destroyed before
///             that leaves nothing. A picture of that name is replaced. The bytes depend on the
///             pixels alone, not on how they were divided into bands.
/// Memory      one row and the compressor's 300 KB.
/// Errors      Unwritable, with the operating system's reason. After an error only destroy it.
/// Threads     one thread.
class PNGWriter
{
public:
  enum class Pixels : std::uint8_t
  {
    RGB8, ///< red, green, blue
    RGBA8 ///< and opacity, not multiplied into the colours
  };
  struct Size
  {
    std::uint32_t width = 0; ///< 1 to 2^31 - 1
    std::uint32_t height = 0; ///< likewise
  };

  static Result<std::unique_ptr<PNGWriter>> create(
    const std::string& path, Size size, Pixels pixels);
  ~PNGWriter();
  PNGWriter(const PNGWriter&) = delete;
  PNGWriter& operator=(const PNGWriter&) = delete;

  /// The next `count` rows, from the top of the picture down.
  /// strideBytes  from one row to the next; negative where the rows lie bottom up in memory.
  Result<void> append(
    const std::uint8_t* firstRow, std::uint32_t count, std::ptrdiff_t strideBytes);
  /// To be called after the last row: writes the end and gives the file its name.
  Result<void> finish();

private:
  struct Stream;
  explicit PNGWriter(std::unique_ptr<Stream> stream);

  std::unique_ptr<Stream> stream_;
};

} // namespace pointfront
