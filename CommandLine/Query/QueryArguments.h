#pragma once

#include "pointfront/Query/PointQuery.h"
#include "pointfront/Store/StoredCloud.h"

#include <CLI/CLI.hpp>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// The options that choose points of a store: --box, --polygon, --corridor, --sphere, --classes,
/// --where, --spacing. A point must meet all that are given.
class QueryArguments
{
public:
  void declare(CLI::App& app);
  /// Files that they name, for checkOutputTarget().
  std::vector<std::string> files() const;
  /// The query that they mean for a store. `notes` gets sentences that the user should know.
  Result<PointQuery> query(const StoreDescription& store, std::vector<std::string>& notes) const;

private:
  void declareRegions(CLI::App& app);
  void declareConditions(CLI::App& app);
  Result<void> addPolygon(
    const StoreDescription& store, PointQuery& query, std::vector<std::string>& notes) const;
  Result<void> addCorridor(
    const StoreDescription& store, PointQuery& query, std::vector<std::string>& notes) const;

  PointQuery query_; ///< the part that needs no store
  std::optional<Bounds> box_;
  std::optional<std::array<double, 4>> sphere_;
  std::string polygonPath_;
  std::string corridorPath_;
  double within_ = 0.0;
};

} // namespace pointfront
