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

/// A node and the LAZ chunk that holds its points.
struct COPCEntry
{
  ForeignNode node; ///< chunk: the entry's place in the list
  std::uint64_t offset = 0;
  std::uint32_t bytes = 0;
};

/// Errors  Unsupported: no COPC file; Corrupt: a record of another size.
Result<COPCInfo> readCOPCInfo(const LASFile& file);
/// All entries with points or without, of all pages. Pages of one level are read together.
/// Errors  Corrupt, with the byte: pages outside of the file or referred to twice, chunks outside,
///         counts that are none.
Result<std::vector<COPCEntry>> readCOPCHierarchy(const LASFile& file, const COPCInfo& info);

/// COPC files as stored clouds: drawn, queried and exported as they are.
/// Errors  of open(): those of LASFile, LAZCompression and the above; of the first points.
class COPCFormat final : public StoredCloudFormat
{
public:
  std::string name() const override { return "COPC"; }
  /// By the record that must come first in the file.
  bool accepts(const std::string& path) const override;
  Result<std::shared_ptr<const StoredCloud>> open(const std::string& path) const override;
};

} // namespace pointfront
