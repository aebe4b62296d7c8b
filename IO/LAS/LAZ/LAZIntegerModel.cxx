#include "LAZIntegerModel.h"

#include <algorithm>

namespace pointfront
{

LAZSymbolModel::LAZSymbolModel(std::uint32_t symbols)
  : counts(symbols, 1)
  , distribution(symbols)
  , cycle(symbols)
{
  update();
  untilUpdate = cycle = (symbols + 6) >> 1;
}

void LAZSymbolModel::update()
{
  const auto symbols = static_cast<std::uint32_t>(counts.size());
  total += cycle;
  if (total > (1u << shift))
  {
    total = 0;
    for (std::uint32_t& count : counts)
    {
      count = (count + 1) >> 1;
      total += count;
    }
  }
  const std::uint32_t scale = 0x80000000u / total;
  std::uint32_t sum = 0;
  for (std::uint32_t k = 0; k < symbols; ++k)
  {
    distribution[k] = (scale * sum) >> (31 - shift);
    sum += counts[k];
  }
  cycle = std::min((5 * cycle) >> 2, (symbols + 6) << 3);
  untilUpdate = cycle;
}

void LAZBitModel::update()
{
  total += cycle;
  if (total > (1u << shift))
  {
    total = (total + 1) >> 1;
    zeroCount = (zeroCount + 1) >> 1;
    total += zeroCount == total ? 1 : 0;
  }
  zeroProbability = (zeroCount * (0x80000000u / total)) >> (31 - shift);
  cycle = std::min((5 * cycle) >> 2, 64u);
  untilUpdate = cycle;
}

} // namespace pointfront
