#pragma once

#include "pointfront/Query/Region.h"
#include "pointfront/Style/FilterExpression.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// Which points of a stored cloud are wanted, and with which attributes. All by default; a point
/// must meet every condition.
struct PointQuery
{
  /// Inside or on all of these.
  std::vector<std::shared_ptr<const Region>> regions;
  /// `classification` is one of these; empty: any.
  std::vector<std::uint8_t> classes;
  /// Ranges of attributes and coordinates.
  FilterExpression where;
  /// World units between neighbouring points: a branch is followed down until its nodes are at
  /// least this dense and no further, so the result is as dense as asked or a little denser,
  /// never coarser (where the cloud has that much). 0: all points of the input.
  /// Of a store with mean representatives these come out where they are dense enough, and nothing
  /// of what they stand for.
  double spacing = 0.0;
  /// Names of those that come with each point, in the store's order. Default: all that the cloud
  /// holds (but the enclosing radius of representatives where only points of the input come).
  std::optional<std::vector<std::string>> attributes;
};

} // namespace pointfront
