#pragma once

#include "pointfront/Disk/SpillFile.h"
#include "pointfront/Neighbourhood/InputOrder.h"
#include "pointfront/Points/AttributeSchema.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// Values of all points, by their number in input order, in an unnamed file. Values that were
/// computed from neighbours wait there until their source is read. Unwritten places have zero
/// bytes.
/// Threads  write() and read() from any thread, on separate points.
class PointColumn
{
public:
  static Result<std::unique_ptr<PointColumn>> create(
    const PassResources& resources, std::uint64_t points, std::size_t valueBytes);

  std::size_t valueBytes() const { return valueBytes_; }
  /// `numbers`: runs of successive ones are written at once; `values`: valueBytes() each.
  Result<void> write(
    const std::vector<std::uint64_t>& numbers, const std::vector<std::byte>& values);
  Result<void> read(std::uint64_t first, std::uint64_t count, std::byte* values) const;

private:
  PointColumn(std::unique_ptr<SpillFile> file, std::size_t valueBytes)
    : file_(std::move(file))
    , valueBytes_(valueBytes)
  {
  }
  std::unique_ptr<SpillFile> file_;
  std::size_t valueBytes_;
};

/// Gives the points of one chunk their new values: bytes of all new attributes of a point side by
/// side, one after another for each point.
/// `batch` has the source's own columns; called from any thread.
using ValueSource =
  std::function<Result<void>(const SourceChunk&, const PointBatch& batch, std::byte* values)>;

/// Sources that give the points of the originals with the new attributes. These come behind the
/// others, or replace an attribute of the same name. `describe`: what else changes in their
/// descriptions.
PointSources withAttributes(PointSources sources, const std::vector<Attribute>& attributes,
  const ValueSource& values, const std::function<void(SourceDescription&)>& describe = {});

/// A ValueSource that reads a column.
ValueSource valuesOf(std::shared_ptr<const PointColumn> column, InputOrder order);

} // namespace pointfront
