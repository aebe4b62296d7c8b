#pragma once

#include "pointfront/Codec/BlockCodec.h"

#include <cstddef>
#include <cstdint>

namespace pointfront
{

/// How a value of a packed block is predicted. The numbers are part of the format.
enum class Predictor : std::uint8_t
{
  Zero = 0, ///< code = value
  PointBefore = 1, ///< code = zigzag(value - value of the point before)
  SecondComponent = 2 ///< as 1, after component 1 was subtracted from 0 and 2: colours
};
constexpr std::uint8_t predictorCount = 3;

/// Set in the byte of the predictor: a factor follows that all values were divided by.
constexpr std::byte factorFlag{ 0x80 };

inline bool predictable(Predictor predictor, const BlockShape& shape)
{
  return predictor != Predictor::SecondComponent ||
    (shape.components == 3 && shape.scalarBytes <= 2);
}

} // namespace pointfront
