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
  std::vector<EPTNode> nodes; ///< those of the pages that were read, sorted by their keys
  std::vector<std::string> pages; ///< keys of pages of the hierarchy that were not read
  std::shared_ptr<const ByteSource> source; ///< source of the ept.json: how the files are read
  RawBytes first; ///< only in a far tree: the file of the first node, which each reader needs
                  ///< several times

  /// By the path of its ept.json. Hierarchies of trees that are not of laszip are read whole.
  /// Errors  NotFound, Unreadable; those of EPTDescription and readEPTHierarchy().
  static Result<std::shared_ptr<const EPTFolder>> open(
    const std::string& path, EPTDepth depth = EPTDepth::Whole);

  std::string fileOf(const EPTNode& node) const;
  /// Errors  those of readSmallFile(): a node has no more bytes than its points may take.
  Result<RawBytes> readNode(const EPTNode& node) const;
  /// Several, those of a far tree beside each other.
  std::vector<Result<RawBytes>> readNodes(
    const std::vector<EPTNode>& wanted, const ReadStop& stop) const;

private:
  std::uint64_t mostBytesOf(const EPTNode& node) const;
};

} // namespace pointfront
