#pragma once

#include "PCDHeader.h"

#include "pointfront/Base/MemoryMap.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Table/PointTable.h"

#include <string>
#include <vector>

namespace pointfront
{

/// A PCD file with its header understood: what its tables share.
struct PCDFile
{
  /// Where the numbers of one TableField are in a point.
  struct Element
  {
    std::size_t field = 0; ///< number of the header's field
    std::size_t byte = 0; ///< within that field
    ScalarType type = ScalarType::Float32;
  };

  MemoryMap map;
  std::string path;
  PCDHeader header;
  std::string format; ///< "PCD binary" ...
  std::vector<std::string> warnings;
  /// One for each element of each field, but not padding and not fields of more than 16. A packed
  /// colour is three of 8 bits: red, green, blue; its alpha is left out.
  std::vector<TableField> fields;
  std::vector<Element> elements; ///< elements of each of `fields`

  /// Errors  of MemoryMap::open and PCDHeader::parse.
  static Result<PCDFile> open(const std::string& path);
  /// How many points are there if `present` of those promised are. A file that was cut short gives
  /// what it has, with a warning; one with less than half of what its header promises was never
  /// such a file. Errors  Truncated.
  Result<std::uint64_t> countPresent(std::uint64_t present);
  /// From where the points were seen: VIEWPOINT, in the frame of the points. Writers that know
  /// nothing of a sensor write 0 0 0, too: that is believed if the origin is near the points,
  /// within ten times their extent, as for a depth camera, but not for coordinates of a survey.
  std::vector<ScannerPlace> scanners(const Bounds& positions) const;
};

} // namespace pointfront
