#pragma once

#include <cstdint>
#include <vector>

namespace pointfront
{

// The encoder and the decoder of the integers of a LAZ chunk table have these alike. See
// LAZIntegerDecoder for the sources.

constexpr std::uint32_t lazLeastInterval = 0x01000000u; ///< below it a byte is shifted
constexpr std::uint32_t lazIntegerBits = 32;
constexpr std::uint32_t lazModelledBits = 8; ///< upper bits of a difference; lower ones are stored

/// Probabilities of a small alphabet, learnt on the way.
struct LAZSymbolModel
{
  static constexpr std::uint32_t shift = 15; ///< precision of probabilities

  explicit LAZSymbolModel(std::uint32_t symbols);
  /// Learns that `symbol` came.
  void learn(std::uint32_t symbol)
  {
    ++counts[symbol];
    if (--untilUpdate == 0)
    {
      update();
    }
  }
  void update();

  std::vector<std::uint32_t> counts;
  std::vector<std::uint32_t> distribution;
  std::uint32_t total = 0;
  std::uint32_t cycle = 0;
  std::uint32_t untilUpdate = 0;
};

/// The same for one bit.
struct LAZBitModel
{
  static constexpr std::uint32_t shift = 13; ///< precision of probabilities

  /// Learns that the bit was one, or zero.
  void learn(bool one)
  {
    zeroCount += one ? 0 : 1;
    if (--untilUpdate == 0)
    {
      update();
    }
  }
  void update();

  std::uint32_t zeroCount = 1;
  std::uint32_t total = 2;
  std::uint32_t zeroProbability = 1u << 12;
  std::uint32_t cycle = 4;
  std::uint32_t untilUpdate = 4;
};

} // namespace pointfront
