#pragma once

#include "EPTDescription.h"

#include "pointfront/Base/RawBytes.h"
#include "pointfront/Disk/ByteSource.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// An Entwine tree on a disk or behind an address: its description, and its nodes with points.
struct EPTFolder
{
  std::string path; ///< path of the ept.json
  std::string place; ///< the same, absolute
  std::uint64_t descriptionBytes = 0;
  EPTDescription description;
  std::vector<EPTNode> nodes; ///< sorted by their keys
  std::shared_ptr<const ByteSource> source; ///< source of the ept.json: how the files are read
  RawBytes first; ///< only in a far tree: the file of node 0, which each reader needs several times

  /// By the path of its ept.json.
  /// Errors  NotFound, Unreadable; those of EPTDescription and readEPTHierarchy().
  static Result<std::shared_ptr<const EPTFolder>> open(const std::string& path);

  /// The file of a node, by its place in the list.
  std::string fileOf(std::uint64_t node) const;
  /// Errors  those of readSmallFile(): a node has no more bytes than its points may take.
  Result<RawBytes> readNode(std::uint64_t node) const;
  /// Several, those of a far tree beside each other.
  std::vector<Result<RawBytes>> readNodes(
    const std::vector<std::uint64_t>& wanted, const ReadStop& stop) const;

private:
  std::uint64_t mostBytesOf(std::uint64_t node) const;
};

} // namespace pointfront
