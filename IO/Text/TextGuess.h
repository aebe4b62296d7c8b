#pragma once

#include <string>
#include <vector>

namespace pointfront
{

/// Names for columns that have none, from what the first rows hold; see TextColumns::find.
/// Shapes   rows[i][c]; NaN where a cell is no number: a column of which most are none is "-".
std::vector<std::string> guessColumns(
  const std::vector<std::vector<double>>& rows, std::size_t columns);

} // namespace pointfront
