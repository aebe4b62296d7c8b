#pragma once

#include "pointfront/Points/PointSource.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// The metadata record that marks a store as the preview of a store that is still being built.
/// Because it is metadata, every reader of the format shows previews (ADR 0011, SMOOTH-1).
struct PreviewRecord
{
  std::string storeName; ///< file name of the finished store, in the preview's folder
  std::uint64_t pointsExpected = 0; ///< points of the finished store, as the inputs announce them
  std::uint64_t pointsRead = 0; ///< that the build had read when the preview was written
  std::uint64_t pointsFinished = 0; ///< points of parts that the preview shows in full
};

MetadataRecord previewMetadata(const PreviewRecord& record);

/// The record among a store's metadata; nothing: the store is finished.
std::optional<PreviewRecord> previewRecordOf(const std::vector<MetadataRecord>& metadata);

/// "folder/city.pfront" -> "folder/city.preview.pfront": beside the store, with its extension, so
/// that every program that opens stores opens it.
std::string previewPathOf(const std::string& storePath);

/// The other way round; nothing if the path is not named like a preview.
std::optional<std::string> storePathOfPreview(const std::string& previewPath);

/// The path as it is, or that of the finished store for a preview that is gone.
std::string presentStorePath(const std::string& path);

} // namespace pointfront
