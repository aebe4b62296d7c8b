#pragma once

#include "EPTFolder.h"
#include "EPTFormat.h"
#include "EPTNodeDecoder.h"

#include <memory>
#include <string>

namespace pointfront
{

/// The LAZ files of an Entwine tree.
/// Errors  open: of the first file. decode: of the node's file; BadFormat where it is another than
///         the hierarchy says, or has other attributes or another grid than the first.
class EPTLasNodes final : public EPTNodeDecoder
{
public:
  static Result<std::unique_ptr<EPTNodeDecoder>> open(
    std::shared_ptr<const EPTFolder> tree, EPTFormat::Opener openNode);

  const SourceDescription& description() const override { return description_; }
  Result<void> decode(const EPTNode& node, const RawBytes& file, PointBatch& batch) const override;

private:
  EPTLasNodes() = default;

  std::shared_ptr<const EPTFolder> tree_;
  EPTFormat::Opener openNode_;
  SourceDescription description_;
};

} // namespace pointfront
