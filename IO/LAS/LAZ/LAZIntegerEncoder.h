#pragma once

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
  /// Probabilities of a small alphabet, learnt while encoding.
  struct Model
  {
    explicit Model(std::uint32_t symbols);
    void update();

    std::vector<std::uint32_t> counts;
    std::vector<std::uint32_t> distribution;
    std::uint32_t total = 0;
    std::uint32_t cycle = 0;
    std::uint32_t untilUpdate = 0;
  };

  /// The same for one bit.
  struct BitModel
  {
    void update();

    std::uint32_t zeroCount = 1;
    std::uint32_t total = 2;
    std::uint32_t zeroProbability = 1u << 12;
    std::uint32_t cycle = 4;
    std::uint32_t untilUpdate = 4;
  };

  void symbol(Model& model, std::uint32_t value);
  void bit(BitModel& model, bool one);
  void bits(std::uint32_t value, std::uint32_t count);
  void advance(std::uint32_t step);
  void renormalise();

  std::vector<std::byte> bytes_;
  std::uint32_t base_ = 0;
  std::uint32_t length_ = 0xFFFFFFFFu;
  std::array<Model, 2> widths_;
  BitModel zeroOrOne_;
  std::vector<Model> highBits_;
};

} // namespace pointfront
