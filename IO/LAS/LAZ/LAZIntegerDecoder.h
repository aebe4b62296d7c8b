#pragma once

#include "LASBytes.h"

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
  /// Probabilities of a small alphabet, learnt while decoding.
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

  std::uint32_t symbol(Model& model);
  std::uint32_t bit(BitModel& model);
  std::uint32_t bits(std::uint32_t count);
  std::uint32_t difference(Model& width);
  void renormalise();
  std::uint32_t byte();

  ByteSpan bytes_;
  std::size_t at_ = 0;
  bool sound_ = true;
  std::uint32_t value_ = 0;
  std::uint32_t length_ = 0xFFFFFFFFu;
  std::array<Model, 2> widths_; ///< how many bits a difference has, for each context
  BitModel zeroOrOne_; ///< differences of width 0
  std::vector<Model> highBits_; ///< upper bits of a difference, for each width from 1
};

} // namespace pointfront
