#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace pointfront
{

/// How the bytes of a block give its values. The numbers are part of the format: never renumber.
enum class BlockCodec : std::uint8_t
{
  Raw = 0, ///< the values as they are
  Constant = 1, ///< all points have the value that is stored once
  Packed = 2, ///< differences in groups of 128, as many bits as most of them need
  PlanesZstd = 3 ///< differences in planes of bytes, then Zstandard
};

/// True for the codecs that decodeBlock() knows.
bool knownBlockCodec(std::uint8_t codec);

/// The shape of a block: `points` times `components` scalars of `scalarBytes` bytes, interleaved.
/// Scalars are coded as unsigned integers of their size, floating point by its bits, so every value
/// (each NaN too) comes back bit for bit.
struct BlockShape
{
  std::size_t points = 0;
  unsigned components = 1; ///< 1 to 16
  unsigned scalarBytes = 1; ///< 1, 2, 4 or 8

  std::size_t pointBytes() const { return std::size_t(components) * scalarBytes; }
  std::size_t bytes() const { return points * pointBytes(); }
};

/// The last points of a block, enough to choose how to code the whole. (The last, because they are
/// the last and densest batch of a node: neighbours in space.)
BlockShape sampleOf(const BlockShape& shape);

/// The coded bytes of a block and their codec.
struct CodedBlock
{
  BlockCodec codec = BlockCodec::Raw;
  std::vector<std::byte> bytes;
};

/// Codes `values` (shape.bytes() bytes) with the codec that suits them. Pure: the same values give
/// the same bytes on any thread.
CodedBlock encodeBlock(const std::byte* values, const BlockShape& shape);

/// The same for a block of which all points have `value` (shape.pointBytes() bytes).
CodedBlock encodeConstant(const std::byte* value, const BlockShape& shape);

/// Decodes into `values` (shape.bytes() bytes). False when the coded bytes are not what a block of
/// this shape looks like.
/// Guarantees  reads only [coded, coded + codedBytes), writes only shape.bytes() bytes, whatever
///             the coded bytes are.
bool decodeBlock(BlockCodec codec, const std::byte* coded, std::size_t codedBytes,
  const BlockShape& shape, std::byte* values);

} // namespace pointfront
