#pragma once

#include "EPTDescription.h"

#include "pointfront/Base/RawBytes.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// An Entwine tree on the disk: its description, and its nodes with points.
struct EPTFolder
{
  std::string path; ///< path of the ept.json
  std::string folder; ///< that holds it, absolute
  std::uint64_t descriptionBytes = 0;
  EPTDescription description;
  std::vector<EPTNode> nodes; ///< sorted by their keys

  /// By the path of its ept.json.
  /// Errors  NotFound, Unreadable; those of EPTDescription and readEPTHierarchy().
  static Result<std::shared_ptr<const EPTFolder>> open(const std::string& path);

  /// The file of a node, by its place in the list.
  std::string fileOf(std::uint64_t node) const;
  /// Errors  those of readSmallFile(): a node has no more bytes than its points may take.
  Result<RawBytes> readNode(std::uint64_t node) const;
};

} // namespace pointfront
