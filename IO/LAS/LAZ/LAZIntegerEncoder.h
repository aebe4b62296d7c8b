#pragma once

#include "LAZIntegerModel.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// Encodes the integers of a LAZ chunk table: what LAZIntegerDecoder reads.
/// Source   as there.
/// Threads  one thread.
class LAZIntegerEncoder
{
public:
  LAZIntegerEncoder();

  /// The next integer of the series `context` (0 or 1).
  void add(std::uint32_t prediction, std::uint32_t integer, int context);
  /// The bytes of all that was added. Nothing may follow.
  std::vector<std::byte> finish();

private:
  void symbol(LAZSymbolModel& model, std::uint32_t value);
  void bit(LAZBitModel& model, bool one);
  void bits(std::uint32_t value, std::uint32_t count);
  void advance(std::uint32_t step);
  void renormalise();

  std::vector<std::byte> bytes_;
  std::uint32_t base_ = 0;
  std::uint32_t length_ = 0xFFFFFFFFu;
  std::array<LAZSymbolModel, 2> widths_;
  LAZBitModel zeroOrOne_;
  std::vector<LAZSymbolModel> highBits_;
};

} // namespace pointfront
