#include "Percentiles.h"

#include <algorithm>
#include <cmath>

namespace pointfront
{

Percentiles percentilesOf(std::vector<double> values)
{
  if (values.empty())
  {
    return {};
  }
  std::sort(values.begin(), values.end());
  const auto rank = [&values](double share)
  {
    const double count = std::ceil(share * static_cast<double>(values.size()));
    return values[static_cast<std::size_t>(std::max(count, 1.0)) - 1];
  };
  return { rank(0.50), rank(0.95), rank(0.99), values.back() };
}

} // namespace pointfront
