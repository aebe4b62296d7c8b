#pragma once

#include "pointfront/Store/Hierarchy.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// Chooses the nodes that are released when memory is short, over any number of stores.
/// Order    by distance under the front, farthest first; at one distance by store and highest node.
/// Source   Richter & Doellner 2010, section 3.2.3: one pass counts the bytes at each distance, a
///          second takes all beyond a distance and of that one what is still missing (FRONT-10).
/// Threads  a value of one thread.
class ReleasePlan
{
public:
  struct Candidate
  {
    std::uint32_t levels; ///< under the front
    std::uint32_t store;
    NodeIndex node;
    std::size_t bytes;
  };

  /// First pass. A node at distance 0 is needed and is no candidate.
  void count(std::uint32_t store, NodeIndex node, std::size_t bytes, std::uint32_t levels);
  /// Second pass: at least `bytes`, as far as there are any.
  std::vector<Candidate> farthest(std::size_t bytes);

private:
  /// More levels than any tree has: what nobody wants at all may come with any number.
  static constexpr std::uint32_t farthestCounted = 255;
  std::array<std::size_t, farthestCounted + 1> bytesAt_{};
  std::vector<Candidate> candidates_;
};

} // namespace pointfront
