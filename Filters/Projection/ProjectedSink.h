#pragma once

#include "pointfront/Points/ForwardingSink.h"
#include "pointfront/Reference/CoordinateSystems.h"

#include <memory>
#include <string>

namespace pointfront
{

/// Points on their way into a sink, transformed into another coordinate reference system.
/// Grid      of the result: at most 1 mm, see transformedGrid().
/// Heights   are transformed where both systems name them; else they stay as they are.
/// Left out  points that cannot be transformed; findings() counts them.
/// Errors    BadArgument: the points name no system as WKT, or none of them can be transformed.
class ProjectedSink final : public ForwardingSink
{
public:
  /// `target`: a code, a definition, or the path of a file that holds one.
  /// `assumedName`: see sinkInSystem().
  ProjectedSink(std::unique_ptr<PointSink> sink, std::string target, std::string assumedName);
  ~ProjectedSink() override;

  Result<void> begin(const SinkDescription& description) override;
  Result<void> append(const PointBatch& batch) override;
  std::vector<std::string> findings() const override;

private:
  std::string target_;
  std::string assumedName_;
  std::unique_ptr<CoordinateTransform> transform_; ///< since begin(); null: the same system
  AttributeSchema schema_;
  PointBatch batch_; ///< the rest of the last batch
  std::uint64_t lost_ = 0;
};

} // namespace pointfront
