#include "pointfront/Trees/SparseLeaves.h"

#include <algorithm>
#include <cstddef>

namespace pointfront
{
namespace
{
constexpr double sparseArea = 0.1;
constexpr double unevenFrom = 2.0;
} // namespace

SparseLeaves::SparseLeaves(const std::vector<Square>& squares)
  : ratios_(squares.size(), 1.0f)
{
  std::vector<NodeIndex> sparsestFirst;
  for (NodeIndex i = 0; i < squares.size(); ++i)
  {
    if (squares[i].whole)
    {
      sparsestFirst.push_back(i);
    }
  }
  std::stable_sort(sparsestFirst.begin(), sparsestFirst.end(),
    [&](NodeIndex a, NodeIndex b) { return squares[a].spacing > squares[b].spacing; });

  std::vector<double> counted(squares.size(), 0.0);
  for (const NodeIndex leaf : sparsestFirst)
  {
    const Square& sparse = squares[leaf];
    for (NodeIndex above = sparse.parent; above != noNode; above = squares[above].parent)
    {
      const Square& square = squares[above];
      const double enough = sparseArea * square.area;
      const bool wereEnough = counted[above] > enough;
      counted[above] += sparse.area;
      if (!wereEnough && counted[above] > enough && sparse.spacing >= unevenFrom * square.spacing)
      {
        ratios_[above] = static_cast<float>(sparse.spacing / square.spacing);
      }
    }
  }
}

} // namespace pointfront
