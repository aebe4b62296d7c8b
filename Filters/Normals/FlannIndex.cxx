#include "FlannIndex.h"

#include <flann/flann.hpp>

#include <limits>

namespace pointfront
{
namespace
{
constexpr int leafPlaces = 32; // searches are for a hundred places and more

/// Lets FLANN fill a NeighbourList.
class ListAsResult final : public flann::ResultSet<double>
{
public:
  explicit ListAsResult(NeighbourList& list)
    : list_(list)
  {
  }
  bool full() const override { return list_.full(); }
  void addPoint(double squaredDistance, std::size_t index) override
  {
    list_.offer(squaredDistance, static_cast<std::uint32_t>(index));
  }
  /// FLANN leaves out what is not nearer than this, the list only what is farther than its bound.
  double worstDist() const override
  {
    return list_.bound() * (1.0 + 4.0 * std::numeric_limits<double>::epsilon()) +
      std::numeric_limits<double>::min();
  }

private:
  NeighbourList& list_;
};
} // namespace

struct FlannIndex::Tree
{
  explicit Tree(const PositionSet& set)
    : index(matrixOf(set), flann::KDTreeSingleIndexParams(leafPlaces, true))
  {
    index.buildIndex();
  }
  /// FLANN takes pointers to what it does not change.
  static flann::Matrix<double> matrixOf(const PositionSet& set)
  {
    static_assert(sizeof(glm::dvec3) == 3 * sizeof(double), "rows of three packed doubles");
    return { const_cast<double*>(&set.positions[0].x), set.positions.size(), 3 };
  }
  flann::KDTreeSingleIndex<flann::L2_3D<double>> index;
};

FlannIndex::FlannIndex(const PositionSet& set, float eps)
  : tree_(set.positions.empty() ? nullptr : std::make_unique<Tree>(set))
  , eps_(eps)
{
}

FlannIndex::~FlannIndex() = default;

void FlannIndex::search(const glm::dvec3& from, NeighbourList& list) const
{
  if (!tree_)
  {
    return;
  }
  ListAsResult result(list);
  tree_->index.findNeighbors(
    result, &from.x, flann::SearchParams(flann::FLANN_CHECKS_UNLIMITED, eps_));
}

} // namespace pointfront
