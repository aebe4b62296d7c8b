#pragma once

#include "pointfront/Base/Result.h"

#include <cstddef>
#include <cstdint>
#include <functional>

namespace pointfront
{

/// Unpacks one LZF block: literal runs of up to 32 bytes, and copies of up to 264 bytes from at
/// most 8 KiB back. Every length and distance is checked against what is there.
/// Memory   the output goes to `write` in pieces of up to 1 MiB, in order; only the last 8 KiB are
///          kept, so a block of any size needs no memory of its size.
/// Errors   of `write`; Corrupt: the block ends inside a run, reaches back before its beginning, or
///          does not unpack to exactly `outputBytes`. Says at which byte of the block.
/// Source   Marc Lehmann, LibLZF 3.6, lzf_d.c (the format; the code is our own).
Result<void> decodeLZF(const std::byte* block, std::size_t blockBytes, std::uint64_t outputBytes,
  const std::function<Result<void>(const std::byte*, std::size_t)>& write);

} // namespace pointfront
