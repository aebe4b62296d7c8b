#pragma once

#include "pointfront/Store/StoredCloud.h"

namespace pointfront
{

/// How deep a cloud's 16-bit colours ("rgb") are, as a build decides it. Stores of ours know it,
/// and so does the type of 8 bits; of files that are read in place the largest value tells it.
enum class HeldColours
{
  None, ///< no colours, or all of them black
  Eight,
  Sixteen
};
HeldColours heldColours(const StoreDescription& cloud);

} // namespace pointfront
