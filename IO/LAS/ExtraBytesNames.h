#pragma once

#include "pointfront/Points/AttributeSchema.h"

#include <string>
#include <vector>

namespace pointfront
{

/// Bytes of a name in a descriptor of extra bytes.
constexpr std::size_t lasExtraBytesName = 32;

/// Gives attributes that become extra bytes names of at most 32 bytes, each of them once and none
/// of them that of a `fields`: longer names are cut between characters, an index "[2]" at their end
/// stays, and "_2", "_3" ... tell names apart that would be the same. Names that are right stay.
/// Returns one sentence for each name that changes.
/// Source   ASPRS LAS 1.4 R15, table 24.
std::vector<std::string> shortenExtraBytesNames(
  const AttributeSchema& fields, std::vector<Attribute>& extra);

} // namespace pointfront
