#pragma once

#include "LASFile.h"

#include "pointfront/Disk/InputFile.h"
#include "pointfront/InPlace/SideFile.h"
#include "pointfront/Store/StoredCloud.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// A LAS file that is drawn in place, through the side file that indexLASFile() made. Points are
/// read from the LAS file where they lie; a disk that goes away gives errors, not signals.
/// Order     a node's points by prefix batches, each in the order of the file.
/// Threads   all functions are safe from any thread.
/// Errors    open: those of SideFile and LASFile; NotFound if the LAS file is not where the side
///           file says; Corrupt if it is not the file that was indexed, with what differs.
///           fetch: Unreadable, Truncated; Corrupt with the node.
/// Limits    the LAS file must not be written to while it is open (see MemoryMap).
class IndexedLASFile final : public StoredCloud
{
public:
  static Result<std::shared_ptr<const IndexedLASFile>> open(const std::string& sidePath);

  const StoreDescription& description() const override { return description_; }
  const std::shared_ptr<const Hierarchy>& hierarchy() const override { return hierarchy_; }
  std::vector<std::string> files() const override
  {
    return { description_.path, file_.description.path };
  }
  Result<FetchedNode> fetch(NodeIndex node, const ColumnSelection& columns) const override;
  Result<NodeColumns> decode(const FetchedNode& fetched) const override;
  std::size_t decodedBytes(
    NodeIndex node, std::uint32_t points, const ColumnSelection& columns) const override;
  /// Whole pages, all of the file's columns: records lie as they lie. And the side file's columns
  /// that are wanted.
  std::size_t storedBytes(NodeIndex node, const ColumnSelection& columns) const override;
  std::uint64_t disk() const override { return points_->device(); }
  /// Also that every point of the LAS file is in exactly one node.
  Result<VerifyReport> verify(const ProgressFunction& progress = {}) const override;

private:
  IndexedLASFile(
    std::unique_ptr<const SideFile> side, LASFile file, std::unique_ptr<const InputFile> points);
  Result<void> checkIdentity(const std::string& sidePath) const;
  void describe(const std::string& sidePath);
  /// Chooses the columns that the side file holds, by their numbers there.
  std::vector<std::uint32_t> heldColumns(const ColumnSelection& columns) const;
  Result<std::string> membersFault(const ProgressFunction& progress) const;

  std::unique_ptr<const SideFile> side_;
  LASFile file_; ///< its map is for opening: pages that are gone raise a signal
  std::unique_ptr<const InputFile> points_;
  StoreDescription description_;
  std::shared_ptr<const Hierarchy> hierarchy_;
};

/// Opens side files of LAS files as stored clouds.
class LASIndexFormat final : public StoredCloudFormat
{
public:
  std::string name() const override { return "index of a LAS file"; }
  bool accepts(const std::string& path) const override;
  Result<std::shared_ptr<const StoredCloud>> open(const std::string& path) const override;
};

} // namespace pointfront
