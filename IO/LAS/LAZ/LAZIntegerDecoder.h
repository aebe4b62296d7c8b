#pragma once

#include "LASBytes.h"
#include "LAZIntegerModel.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace pointfront
{

/// Decodes the integers of a LAZ chunk table: an adaptive arithmetic code of differences to a
/// prediction. Points themselves are LASzip's work; the table is read here because its numbers
/// must be checked before LASzip allocates by them.
/// Source   A. Said, Introduction to Arithmetic Coding, HPL-2004-76 (the coder); M. Isenburg,
///          LASzip: lossless compression of LiDAR data, section 4 (the differences).
class LAZIntegerDecoder
{
public:
  /// Two series of integers (contexts 0 and 1) follow one another in `bytes`.
  explicit LAZIntegerDecoder(ByteSpan bytes);

  /// The next integer of that series; nothing when the bytes end or contradict the code.
  std::optional<std::uint32_t> next(std::uint32_t prediction, int context);

private:
  std::uint32_t symbol(LAZSymbolModel& model);
  std::uint32_t bit(LAZBitModel& model);
  std::uint32_t bits(std::uint32_t count);
  std::uint32_t difference(LAZSymbolModel& width);
  void renormalise();
  std::uint32_t byte();

  ByteSpan bytes_;
  std::size_t at_ = 0;
  bool sound_ = true;
  std::uint32_t value_ = 0;
  std::uint32_t length_ = 0xFFFFFFFFu;
  std::array<LAZSymbolModel, 2> widths_; ///< how many bits a difference has, for each context
  LAZBitModel zeroOrOne_; ///< differences of width 0
  std::vector<LAZSymbolModel> highBits_; ///< upper bits of a difference, for each width from 1
};

} // namespace pointfront
