#pragma once

#include "pointfront/Base/RawBytes.h"
#include "pointfront/Points/PointSource.h"

#include <cstdint>

namespace pointfront
{

/// Decodes the files of an Entwine tree's nodes. Who has read a file asks for its points.
/// Threads  all functions from any thread.
class EPTNodeDecoder
{
public:
  virtual ~EPTNodeDecoder() = default;
  /// The description that holds for all nodes.
  virtual const SourceDescription& description() const = 0;
  /// The points of a node, by its place in EPTFolder::nodes and the bytes of its file.
  /// Errors  of the file's format; BadFormat, Truncated: not the points that the hierarchy says.
  virtual Result<void> decode(
    std::uint64_t node, const RawBytes& file, PointBatch& batch) const = 0;
};

} // namespace pointfront
