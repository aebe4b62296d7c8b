#pragma once

#include "EPTDescription.h"

#include "pointfront/Base/RawBytes.h"
#include "pointfront/Points/PointSource.h"

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
  /// The points of a node, by the bytes of its file.
  /// Errors  of the file's format; BadFormat, Truncated: not the points that the hierarchy says.
  virtual Result<void> decode(
    const EPTNode& node, const RawBytes& file, PointBatch& batch) const = 0;
};

} // namespace pointfront
