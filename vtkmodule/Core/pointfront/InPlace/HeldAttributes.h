#pragma once

#include "pointfront/Codec/ByteStream.h"
#include "pointfront/InPlace/SideFile.h"

#include <cstdint>
#include <string>

namespace pointfront
{

/// The bytes of a side file between its header and its table.
struct SideFilePayload
{
  std::uint64_t begin = 0;
  std::uint64_t end = 0;

  bool holds(std::uint64_t offset, std::uint64_t bytes) const
  {
    return offset >= begin && offset <= end && bytes <= end - offset;
  }
};

/// The end of a table since version 3: how many attributes the file holds, and where each node's
/// values lie. Nothing where it holds none.
void putHeldAttributes(ByteWriter& out, const SideFileContent& content);

/// The fault of the rest of a table's bytes, or an empty text with `content` filled, whose
/// nodes and description are there.
std::string heldAttributesFault(
  ByteReader& in, const SideFilePayload& payload, SideFileContent& content);

} // namespace pointfront
