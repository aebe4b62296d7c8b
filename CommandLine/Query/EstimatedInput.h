#pragma once

#include "pointfront/Points/PointSource.h"
#include "pointfront/Store/StoredCloud.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// A file or a cloud as a StoreEstimate takes it.
struct EstimatedInput
{
  std::string format; ///< as SourceDescription::format; empty: not measured
  double points = 0.0;
  std::size_t attributes = 0;
  /// Least and most bytes of a point in a build: its position, and the attributes that vary. Those
  /// with one value for all points take no room.
  std::array<double, 2> recordBytes{ 0.0, 0.0 };

  /// Takes a cloud of others that is drawn where it lies.
  static EstimatedInput of(const StoreDescription& cloud);
};

/// Learns by looking at some points of files, as a build does, which attributes vary. Of many files
/// it looks at the first few, and takes the others to be alike.
class RecordLook
{
public:
  /// A file of `points`, as the only source.
  EstimatedInput of(std::uint64_t points, const std::vector<std::unique_ptr<PointSource>>& source);

private:
  unsigned looked_ = 0;
  double allBytes_ = 0.0; ///< records of the files that were looked at
  double varyingBytes_ = 0.0;
};

} // namespace pointfront
