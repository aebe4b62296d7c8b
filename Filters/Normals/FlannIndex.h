#pragma once

#include "pointfront/Neighbourhood/NeighbourList.h"

#include <memory>

namespace pointfront
{

/// A search by FLANN's single kd-tree, in double precision.
/// `eps`    0: exact. Larger: branches are left out whose places are at most (1 + eps) times
///          nearer, in squared distance, than what is found already (SearchParams::eps).
/// Memory   about 45 bytes a place.
/// Threads  immutable; the set must live as long as the index.
class FlannIndex final : public NeighbourIndex
{
public:
  FlannIndex(const PositionSet& set, float eps);
  ~FlannIndex() override;
  void search(const glm::dvec3& from, NeighbourList& list) const override;

private:
  struct Tree;
  std::unique_ptr<Tree> tree_; ///< none for an empty set
  float eps_;
};

} // namespace pointfront
