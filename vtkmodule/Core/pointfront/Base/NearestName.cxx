#include "pointfront/Base/NearestName.h"

#include "pointfront/Base/LetterCase.h"

#include <algorithm>

namespace pointfront
{

namespace
{
/// The word as it is compared: "--Color_By" is "--color-by".
std::string plain(const std::string& word)
{
  std::string result = lowered(word);
  std::replace(result.begin(), result.end(), '_', '-');
  return result;
}
} // namespace

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

std::string nearestName(const std::string& word, const std::vector<std::string>& known)
{
  constexpr std::size_t longest = 64; // a whole text in the place of a name is near to none
  if (word.size() > longest)
  {
    return {};
  }
  const std::size_t letters = word.size() - std::min(word.size(), word.find_first_not_of('-'));
  const std::string typed = plain(word);
  std::string nearest;
  std::size_t least = std::max<std::size_t>(1, letters / 3) + 1;
  std::string longer;
  std::size_t begun = 0;
  for (const std::string& candidate : known)
  {
    const std::string name = plain(candidate);
    if (const std::size_t distance = editDistance(typed, name); distance < least)
    {
      least = distance;
      nearest = candidate;
    }
    if (name.compare(0, typed.size(), typed) == 0 && letters >= 2)
    {
      longer = candidate;
      ++begun;
    }
  }
  return nearest.empty() && begun == 1 ? longer : nearest;
}

std::string didYouMean(const std::string& word, const std::vector<std::string>& known)
{
  const std::string meant = nearestName(word, known);
  return meant.empty() ? std::string() : "; did you mean '" + meant + "'?";
}

} // namespace pointfront
