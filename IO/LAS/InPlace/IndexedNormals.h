#pragma once

#include "pointfront/Disk/SpillFile.h"
#include "pointfront/InPlace/InPlaceTable.h"
#include "pointfront/InPlace/SideFile.h"
#include "pointfront/Points/AttributePass.h"
#include "pointfront/Store/StoredCloud.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// A part of an operation's progress, from `first` on.
ProgressFunction partOf(const ProgressFunction& progress, double first, double share);

/// The normals of all points of a LAS file, on their way into its side file.
/// Memory   that of the pass, and a chunk a thread: the normals wait in an unnamed file, 6 bytes a
///          point.
/// Threads  compute() runs its own; append() one thread.
class IndexedNormals
{
public:
  /// Errors  those of the pass and of LASFile::open; Unwritable; Cancelled.
  static Result<std::unique_ptr<IndexedNormals>> compute(
    const std::string& lasPath, const AttributePass& pass, const PassResources& resources);

  /// Appends the normals of a node, in the order of its points' numbers.
  Result<void> append(
    const std::vector<std::uint64_t>& points, SideFileWriter& writer, InPlaceTable& table) const;

  /// The attribute and its range, behind those of a description.
  void describe(StoreDescription& description, const std::string& origin) const;
  /// The findings of the pass, in full sentences.
  const std::vector<std::string>& findings() const { return findings_; }
  std::uint64_t spilledBytes() const { return spilledBytes_; }

private:
  IndexedNormals() = default;

  std::unique_ptr<SpillFile> file_;
  std::uint64_t spilledBytes_ = 0;
  ColumnRange range_;
  std::vector<std::string> findings_;
};

} // namespace pointfront
