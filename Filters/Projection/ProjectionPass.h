#pragma once

#include "ProjCoordinateSystems.h"

#include "pointfront/Points/AttributePass.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// The user's choices of coordinate reference systems.
struct ProjectionOptions
{
  /// The system of the output: a code, a definition, the path of a file that holds one, or "utm":
  /// the zone that the first input lies in. Empty: the system of the first that names one.
  std::string target;
  std::string assumed; ///< likewise without "utm": what inputs are in that name none
  std::string targetName = "--crs"; ///< the two in messages
  std::string assumedName = "--assume-crs";
  bool inputsMayName = true; ///< whether it is worth a finding that no input names a system
};

/// Gives all sources one coordinate reference system (FRONT-1): names it as WKT, also where a file
/// gives it as GeoTIFF keys only, and transforms the points of those that differ.
/// Heights    are transformed where both systems name heights; else they stay as they are, and
///            those that the points have stay named.
/// Grid       transformed points get one of at most 1 mm, see transformedGrid().
/// Unknown    a source whose system is not known stays as it is, with a warning; with a target
///            that is an Error, since its points would be put in the wrong place.
class ProjectionPass final : public AttributePass
{
public:
  explicit ProjectionPass(ProjectionOptions options)
    : options_(std::move(options))
  {
  }
  Result<PointSources> apply(PointSources sources, const PassResources& resources) const override;
  std::vector<std::string> findings() const override { return findings_; }
  bool findsInputs() const override { return true; }
  /// The name of a system may be a file.
  std::vector<std::string> filesRead() const override
  {
    return { options_.target, options_.assumed };
  }
  bool readsPoints() const override { return false; }

private:
  struct StatedSystem : CoordinateSystem
  {
    bool assumed = false; ///< by the user, not said by the source
  };
  using Known = std::optional<StatedSystem>;
  /// How the points of one source get into the target.
  struct Way
  {
    bool same = false; ///< they are in it already
    std::shared_ptr<const CoordinateTransform> transform; ///< null: as they are
  };

  Result<CoordinateSystem> defined(const std::string& definition) const;
  Result<std::vector<Known>> systemsOf(const PointSources& sources) const;
  Known systemOf(const SourceDescription& source) const;
  Result<CoordinateSystem> utmZone(
    const SourceDescription& source, const CoordinateSystem& system) const;
  Result<std::optional<CoordinateSystem>> chooseTarget(
    const PointSources& sources, const std::vector<Known>& systems) const;
  Result<Way> wayFrom(const std::string& path, const CoordinateSystem& from,
    const CoordinateSystem& to, const Bounds& where) const;
  Result<std::vector<Way>> waysTo(const CoordinateSystem& target, const PointSources& sources,
    const std::vector<Known>& systems) const;
  Result<PointSources> inOneSystem(
    PointSources sources, const std::vector<Known>& systems, const CoordinateSystem& target) const;
  void warnOfHeights(const std::string& path, const CoordinateSystem& from,
    const CoordinateSystem& to, bool transformed) const;
  void warnOfDegrees(const PointSources& sources, const std::vector<Known>& systems,
    const std::optional<CoordinateSystem>& target) const;

  ProjectionOptions options_;
  ProjCoordinateSystems known_;
  mutable std::vector<std::string> findings_; ///< sentences of the last apply()
};

} // namespace pointfront
