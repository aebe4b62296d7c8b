#include "Suggestion.h"

#include <algorithm>

namespace pointfront
{

std::size_t editDistance(const std::string& one, const std::string& other)
{
  std::vector<std::vector<std::size_t>> cost(
    one.size() + 1, std::vector<std::size_t>(other.size() + 1));
  for (std::size_t i = 0; i <= one.size(); ++i)
  {
    for (std::size_t k = 0; k <= other.size(); ++k)
    {
      if (i == 0 || k == 0)
      {
        cost[i][k] = i + k;
        continue;
      }
      const std::size_t replaced = cost[i - 1][k - 1] + (one[i - 1] == other[k - 1] ? 0 : 1);
      cost[i][k] = std::min({ cost[i - 1][k] + 1, cost[i][k - 1] + 1, replaced });
      if (i > 1 && k > 1 && one[i - 1] == other[k - 2] && one[i - 2] == other[k - 1])
      {
        cost[i][k] = std::min(cost[i][k], cost[i - 2][k - 2] + 1);
      }
    }
  }
  return cost[one.size()][other.size()];
}

std::string suggestionFor(const std::string& word, const std::vector<std::string>& known)
{
  const std::size_t letters = word.size() - std::min(word.size(), word.find_first_not_of('-'));
  std::string nearest;
  std::size_t least = std::max<std::size_t>(1, letters / 3) + 1;
  std::string longer;
  std::size_t begun = 0;
  for (const std::string& candidate : known)
  {
    if (const std::size_t distance = editDistance(word, candidate); distance < least)
    {
      least = distance;
      nearest = candidate;
    }
    if (candidate.compare(0, word.size(), word) == 0 && letters >= 2)
    {
      longer = candidate;
      ++begun;
    }
  }
  return nearest.empty() && begun == 1 ? longer : nearest;
}

} // namespace pointfront
