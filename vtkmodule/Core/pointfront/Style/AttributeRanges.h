#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Store/StoredCloud.h"

#include <array>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

namespace pointfront
{

/// The ranges over which colours are spread when the style names none. A range covers all stores of
/// one picture, so the same colour means the same value in each of them.
/// Range    2 % to 98 % of a sample of the points (StoreSample), so that a few outliers do not use
///          up the colours. It is the whole range if these are equal, or if no sample could be
///          taken. Infinite values do not count.
/// Cost     the first time that an attribute is asked for, some ten thousand points of each store
///          are read; later nothing.
/// Threads  const functions are safe from any thread.
class AttributeRanges
{
public:
  explicit AttributeRanges(std::vector<std::shared_ptr<const StoredCloud>> stores)
    : stores_(std::move(stores))
  {
  }

  /// Whether one of the stores has an attribute (or component) of that name.
  bool has(const std::string& name) const;
  /// World units; low < high. `name` is an attribute's, a component's, or "elevation"; component 0
  /// of an attribute of several. BadArgument where no store has it; errors of reading.
  Result<std::array<double, 2>> of(const std::string& name) const;

  /// The whole range of one store, from its description.
  static std::array<double, 2> whole(const StoreDescription& store, const std::string& name);

private:
  std::vector<std::shared_ptr<const StoredCloud>> stores_;
  mutable std::mutex mutex_;
  mutable std::map<std::string, std::array<double, 2>> known_;
};

} // namespace pointfront
