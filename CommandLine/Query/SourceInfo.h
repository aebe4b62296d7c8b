#pragma once

#include "pointfront/Points/PointSource.h"
#include "pointfront/Statistics/PointStatistics.h"

#include <nlohmann/json_fwd.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// The facts that `info` tells of a point file: those in its header, and those that were counted.
struct SourceInfo
{
  SourceDescription description;
  std::uint64_t fileBytes = 0; ///< size of the file that was named
  std::optional<PointCount> counted; ///< where all points were read

  /// Opens nothing more: counts where the header gives no bounds.
  static Result<SourceInfo> of(const PointSource& source, const ScanOptions& options);
  /// From statistics that were gathered.
  static SourceInfo of(const PointSource& source, const PointStatistics& statistics);

  std::uint64_t points() const;
  Bounds bounds() const;
  bool pointsFromHeader() const;
  bool boundsFromHeader() const { return !counted; }
  /// The box that the header claims; nothing: no box.
  std::optional<Bounds> headerBounds() const;
  /// From what was counted, by more than the header rounds.
  bool boundsDiffer() const;
  /// The source's own, and where what was counted contradicts the header, full sentences. Bounds
  /// that are too large (EPT rounds them outward) are no contradiction.
  std::vector<std::string> warnings() const;
};

/// The keys of `info --json`: those of a store, null where only a store has them.
nlohmann::ordered_json sourceJson(const SourceInfo& info);
/// For people: one line a fact.
std::string sourceText(const SourceInfo& info);

} // namespace pointfront
