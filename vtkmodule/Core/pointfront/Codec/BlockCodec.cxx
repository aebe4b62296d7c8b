#include "pointfront/Codec/BlockCodec.h"

#include "pointfront/Codec/PackedCodec.h"
#include "pointfront/Codec/PlaneCodec.h"

#include <algorithm>
#include <cstring>

namespace pointfront
{
namespace
{
bool allEqual(const std::byte* values, const BlockShape& shape)
{
  const std::size_t step = shape.pointBytes();
  return std::memcmp(values, values + step, shape.bytes() - step) == 0;
}

CodedBlock raw(const std::byte* values, const BlockShape& shape)
{
  return { BlockCodec::Raw, std::vector<std::byte>(values, values + shape.bytes()) };
}

// Zstandard decodes at a quarter of Packed's rate or less: it has to save a quarter of the bytes,
// and a bit a point (docs/adr/0001-store-codecs.md).
bool worthZstd(std::size_t planesBytes, std::size_t packedBytes, std::size_t points)
{
  return planesBytes + std::max(packedBytes / 4, points / 8) < packedBytes;
}

// In steps that double: a copy for each point would take as long as decoding it.
void repeat(const std::byte* value, std::size_t valueBytes, std::byte* values, std::size_t bytes)
{
  std::memcpy(values, value, valueBytes);
  for (std::size_t done = valueBytes; done < bytes; done *= 2)
  {
    std::memcpy(values + done, values, std::min(done, bytes - done));
  }
}

// Compressing with Zstandard takes longer than all else: first a sample.
bool zstdPromises(const std::byte* values, const BlockShape& shape, std::size_t packedSample)
{
  const BlockShape sample = sampleOf(shape);
  return worthZstd(0, packedSample, sample.points) &&
    worthZstd(encodePlanes(values + (shape.bytes() - sample.bytes()), sample).size(), packedSample,
      sample.points);
}
} // namespace

BlockShape sampleOf(const BlockShape& shape)
{
  constexpr std::size_t samplePoints = 1024;
  BlockShape sample = shape;
  sample.points = std::min(samplePoints, shape.points);
  return sample;
}

bool knownBlockCodec(std::uint8_t codec)
{
  return codec <= static_cast<std::uint8_t>(BlockCodec::PlanesZstd);
}

CodedBlock encodeBlock(const std::byte* values, const BlockShape& shape)
{
  if (shape.points < 2)
  {
    return raw(values, shape);
  }
  if (allEqual(values, shape))
  {
    return encodeConstant(values, shape);
  }
  PackedBlock packed = packBlock(values, shape);
  CodedBlock best{ BlockCodec::Packed, std::move(packed.bytes) };
  if (zstdPromises(values, shape, packed.sampleBytes))
  {
    std::vector<std::byte> planes = encodePlanes(values, shape);
    if (worthZstd(planes.size(), best.bytes.size(), shape.points))
    {
      best = { BlockCodec::PlanesZstd, std::move(planes) };
    }
  }
  return best.bytes.size() < shape.bytes() ? best : raw(values, shape);
}

CodedBlock encodeConstant(const std::byte* value, const BlockShape& shape)
{
  if (shape.points < 2)
  {
    return raw(value, shape);
  }
  return { BlockCodec::Constant, std::vector<std::byte>(value, value + shape.pointBytes()) };
}

bool decodeBlock(BlockCodec codec, const std::byte* coded, std::size_t codedBytes,
  const BlockShape& shape, std::byte* values)
{
  if (shape.points == 0)
  {
    return codedBytes == 0;
  }
  switch (codec)
  {
    case BlockCodec::Raw:
      if (codedBytes != shape.bytes())
      {
        return false;
      }
      std::memcpy(values, coded, codedBytes);
      return true;
    case BlockCodec::Constant:
      if (codedBytes != shape.pointBytes())
      {
        return false;
      }
      repeat(coded, codedBytes, values, shape.bytes());
      return true;
    case BlockCodec::Packed:
      return decodePacked(coded, codedBytes, shape, values);
    case BlockCodec::PlanesZstd:
      return decodePlanes(coded, codedBytes, shape, values);
  }
  return false;
}

} // namespace pointfront
