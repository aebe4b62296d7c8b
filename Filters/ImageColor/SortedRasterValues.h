#pragma once

#include "RasterSource.h"

#include "pointfront/Neighbourhood/PointColumn.h"
#include "pointfront/Points/AttributePass.h"

#include <memory>
#include <vector>

namespace pointfront
{

/// The pixel values of all points of all sources, looked up with the points sorted by place:
/// each tile of an image is then decoded about once however the points are ordered (TEXTURE-1:
/// "the cloud is sorted by the tiles of the aerial images"). The values wait in an unnamed file,
/// by input order.
/// Cost     every source is read twice more, 32 bytes a point in memory or on disk meanwhile.
/// Threads  compute() from one thread, runs its own; read() from any.
class SortedRasterValues
{
public:
  /// Inputs of each source.
  using Inputs = std::vector<std::vector<RasterSource::Input>>;

  /// Is that worth it? A few chunks are read: if the image tiles that one of them touches do not
  /// stay in the cache until the next one is read, nearly all are decoded again for each chunk.
  static Result<bool> areNeeded(const PointSources& sources, const Inputs& inputs,
    const ImageValuesPass::Images& images, const PassResources& resources);

  /// Errors: those of the sources, images and spill files; Cancelled.
  static Result<std::shared_ptr<const SortedRasterValues>> compute(const PointSources& sources,
    const Inputs& inputs, const ImageValuesPass::Images& images, const PassResources& resources);

  enum class Outcome : std::uint8_t
  {
    Without, ///< no image has data for the point
    Taken,
    NotHeld ///< by the column's type
  };
  /// Values of the points of a chunk, valueBytes() each: for each input its outcome, then room for
  /// its value.
  Result<std::vector<std::byte>> read(const SourceChunk& chunk, std::uint64_t points) const;
  std::size_t valueBytes() const { return column_->valueBytes(); }
  /// Where in them the outcome of an input is.
  std::size_t place(std::size_t input) const { return places_[input]; }

private:
  SortedRasterValues(InputOrder order, const Inputs& inputs);
  class Lookup;

  InputOrder order_;
  std::vector<std::size_t> places_;
  std::size_t bytes_ = 0;
  std::unique_ptr<PointColumn> column_;
};

} // namespace pointfront
