#pragma once

#include "EPTDescription.h"
#include "EPTFormat.h"

#include "pointfront/Store/StoredCloud.h"

#include <memory>
#include <string>
#include <utility>

namespace pointfront
{

/// Entwine trees as stored clouds, by their ept.json or its folder: drawn, queried and exported as
/// they are.
/// Opening  of laszip nodes reads the first page of the hierarchy and some nodes; the other pages
///          are read when somebody looks into them, or by openWhole() at once. Of binary and
///          zstandard ones every node is looked through once for the values of its attributes.
/// Disk     the file of a node is read by fetch(), once; decode() has its bytes.
class EPTTreeFormat final : public StoredCloudFormat
{
public:
  explicit EPTTreeFormat(EPTFormat::Opener openNode)
    : openNode_(std::move(openNode))
  {
  }
  std::string name() const override { return "EPT"; }
  bool accepts(const std::string& path) const override;
  /// Errors  those of EPTFormat and ForeignTree; BadFormat: no cube.
  Result<std::shared_ptr<const StoredCloud>> open(const std::string& path) const override
  {
    return openTree(path, EPTDepth::FirstPoints);
  }
  Result<std::shared_ptr<const StoredCloud>> openWhole(const std::string& path) const override
  {
    return openTree(path, EPTDepth::Whole);
  }

private:
  Result<std::shared_ptr<const StoredCloud>> openTree(
    const std::string& path, EPTDepth depth) const;

  EPTFormat::Opener openNode_;
};

} // namespace pointfront
