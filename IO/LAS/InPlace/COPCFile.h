#pragma once

#include "LASFile.h"
#include "LAZCompression.h"

#include "pointfront/InPlace/ForeignTree.h"
#include "pointfront/Store/StoredCloud.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// The info record of a COPC file.
/// Source  COPC 1.0 specification, copc.io.
struct COPCInfo
{
  glm::dvec3 centre{ 0.0 };
  double halfSize = 0.0;
  double spacing = 0.0;
  std::uint64_t rootOffset = 0; ///< offset of the first page of the hierarchy
  std::uint64_t rootBytes = 0;
};

/// Errors  Unsupported: no COPC file; Corrupt: a record of another size.
Result<COPCInfo> readCOPCInfo(const LASFile& file);
/// A page of the hierarchy, by its bytes at `offset` of a file of `fileBytes`. Nodes and pages have
/// the place of their chunk or page.
/// Errors  Corrupt, with the byte: chunks and pages outside of the file, counts that are none.
Result<ForeignPage> parseCOPCPage(
  ByteSpan page, std::uint64_t offset, std::uint64_t fileBytes, const std::string& path);

/// COPC files as stored clouds: drawn, queried and exported as they are.
/// Opening  reads a hierarchy of up to 256 KiB, and of a larger one its first page: the others are
///          read when somebody looks into them. openWhole() reads them all, those of one level
///          together.
/// Errors   of open(): those of LASFile, LAZCompression and the above; of the first points.
class COPCFormat final : public StoredCloudFormat
{
public:
  std::string name() const override { return "COPC"; }
  /// By the record that must come first in the file.
  bool accepts(const std::string& path) const override;
  Result<std::shared_ptr<const StoredCloud>> open(const std::string& path) const override;
  Result<std::shared_ptr<const StoredCloud>> openWhole(const std::string& path) const override;

private:
  static Result<std::shared_ptr<const StoredCloud>> openTree(
    const std::string& path, std::uint64_t mostBytes);
};

} // namespace pointfront
