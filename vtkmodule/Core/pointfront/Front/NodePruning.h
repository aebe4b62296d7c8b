#pragma once

#include "pointfront/Store/Hierarchy.h"

#include <cstdint>
#include <utility>
#include <vector>

namespace pointfront
{

/// Nodes that need not be read because a filter lets none of their points through
/// (docs/user/styles.md).
/// Numbers  node numbers of the store, for its first nodes; nothing is known of the others.
/// Size     one byte a node.
/// Threads  const functions from any thread.
class NodePruning
{
public:
  enum class Verdict : std::uint8_t
  {
    Draw, ///< some of its points may be drawn
    Descend, ///< none of its own, but some of those below it
    Skip ///< none of its own and none below it
  };

  explicit NodePruning(std::vector<Verdict> verdicts)
    : verdicts_(std::move(verdicts))
  {
  }

  Verdict of(NodeIndex node) const
  {
    return node < verdicts_.size() ? verdicts_[node] : Verdict::Draw;
  }
  /// Number of nodes with a known answer.
  std::size_t size() const { return verdicts_.size(); }

private:
  std::vector<Verdict> verdicts_;
};

} // namespace pointfront
