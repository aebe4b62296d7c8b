#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Points/AttributePass.h"

#include <cstddef>
#include <cstdint>
#include <string>

namespace pointfront
{

/// A store while its trees are built: finished subtrees in full, and a sample of the rest.
class PartialStore
{
public:
  virtual ~PartialStore() = default;
  /// Points of the parts that are finished.
  virtual std::uint64_t pointsFinished() const = 0;
  /// Writes it as a store that opens while, and after, the build runs. It must lie in the folder of
  /// the store being built, whose payloads it refers to: those of finished nodes are not copied.
  /// `record` joins its metadata. Errors  Unwritable.
  virtual Result<void> write(const std::string& path, const MetadataRecord& record) = 0;
};

/// An observer that sees a store while its trees are built (BuildPreview).
/// Threads  called from the build's threads, one at a time.
class BuildWatch
{
public:
  virtual ~BuildWatch() = default;
  /// Points of the sources that the build was given, one source for each; each point at most once.
  /// Asked for once, when all are read.
  virtual PointSources sample() = 0;
  /// Whether show() is wanted now. `bytes`: memory that it would take beyond the sample's. Quick:
  /// the build waits.
  virtual bool due(std::size_t bytes) = 0;
  virtual void show(PartialStore& store) = 0;
};

} // namespace pointfront
