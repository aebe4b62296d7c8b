#pragma once

#include "pointfront/Ingest/RecordPacker.h"
#include "pointfront/Points/PointBatch.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pointfront
{

/// Points that are left out, by Rejection.
using RejectionCounts = std::array<std::uint64_t, std::size_t(Rejection::Count)>;

/// Tells for each point of a batch the class with which it is counted. A point without a valid
/// position is in no group, for the reasons for which a build rejects it.
/// Threads  immutable.
class PointGroups
{
public:
  static constexpr std::size_t count = 256;
  static constexpr std::int16_t none = -1;

  explicit PointGroups(const AttributeSchema& schema);

  /// Without a classification of one byte all points are of group 0.
  bool classified() const { return column_.has_value(); }
  /// `groups[i]`: the class of point i, or `none`, which is counted in `rejected`.
  void assign(
    const PointBatch& batch, std::vector<std::int16_t>& groups, RejectionCounts& rejected) const;

private:
  std::optional<std::size_t> column_;
};

} // namespace pointfront
