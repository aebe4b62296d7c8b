#pragma once

#include "pointfront/Codec/BlockCodec.h"

#include <cstddef>
#include <vector>

namespace pointfront
{

/// BlockCodec::Packed: each value is predicted, the error folded to an unsigned code, and 128
/// codes of a component packed with as many bits as most of them need; the few that need more
/// have their upper bytes stored beside ("patched frame of reference").
/// Rate     some hundred million points a second and core: shifts and adds, no tables.
/// Source   Zukowski, Heman, Nes & Boncz 2006, Super-Scalar RAM-CPU Cache Compression (PFOR);
///          the lanes as in Lemire & Boytsov 2015, Decoding billions of integers per second.
std::vector<std::byte> encodePacked(const std::byte* values, const BlockShape& shape);

/// The same, with the bytes of its last groups: those that hold the points of sampleOf(shape).
struct PackedBlock
{
  std::vector<std::byte> bytes;
  std::size_t sampleBytes = 0;
};
PackedBlock packBlock(const std::byte* values, const BlockShape& shape);

/// As decodeBlock(): safe with any bytes.
bool decodePacked(
  const std::byte* coded, std::size_t codedBytes, const BlockShape& shape, std::byte* values);

} // namespace pointfront
