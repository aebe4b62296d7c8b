#pragma once

#include <cstddef>
#include <cstdint>

namespace pointfront
{

/// The store's checksum: the low 32 bits of XXH3-64 with seed 0. Same on every machine.
/// Finds accidents (a flipped bit, a lost page), not forgeries: decoders stay safe without it.
std::uint32_t checksumOf(const std::byte* data, std::size_t size);

/// XXH3-64 of bytes, to tell contents apart; `seed`: the hash of what came before.
std::uint64_t contentHash(const std::byte* data, std::size_t size, std::uint64_t seed = 0);

/// Every reader asks this. Always true in a build for fuzzing: a fuzzer cannot guess checksums, and
/// what lies behind them must be safe without.
bool matchesChecksum(const std::byte* data, std::size_t size, std::uint32_t checksum);

} // namespace pointfront
