#pragma once

#include "pointfront/Base/RawBytes.h"
#include "pointfront/Base/Result.h"
#include "pointfront/InPlace/InPlaceTable.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace pointfront
{

/// Numbers in a file of `count` points of those that a node holds, ascending, from its list of
/// runs. Nothing if the list, which may be damaged, does not give as many as the node's row says.
std::optional<std::vector<std::uint64_t>> pointsOfList(const InPlaceTable& table, NodeIndex node,
  const std::vector<std::byte>& list, std::uint64_t count);

/// Values of one size that lie at a fixed distance from each other in a file: number i at
/// offset + i * stride.
struct ValuesInFile
{
  std::uint64_t offset = 0;
  std::size_t stride = 0; ///< also their size
  std::function<Result<void>(std::uint64_t offset, std::byte* data, std::size_t bytes)> read;
};

/// The values of some numbers (ascending), one behind the other: the disk is read forwards, and
/// what lies close together at once.
Result<RawBytes> gatherValues(
  const ValuesInFile& values, const std::vector<std::uint64_t>& numbers);

} // namespace pointfront
