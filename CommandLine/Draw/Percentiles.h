#pragma once

#include <vector>

namespace pointfront
{

/// The numbers that are reported for many measurements of one thing.
struct Percentiles
{
  double p50 = 0.0;
  double p95 = 0.0;
  double p99 = 0.0;
  double max = 0.0;
};

/// Nearest rank: each is a value that was measured. All 0 for none.
Percentiles percentilesOf(std::vector<double> values);

} // namespace pointfront
