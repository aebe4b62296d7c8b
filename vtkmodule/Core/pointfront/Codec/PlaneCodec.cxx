#include "pointfront/Codec/PlaneCodec.h"

#include "pointfront/Codec/ValueCode.h"

#include <zstd.h>
#include <zstd_errors.h>

#include <cassert>
#include <cstring>
#include <memory>
#include <new>

namespace pointfront
{
namespace
{
constexpr int zstdLevel = 1;

struct FreeZstd
{
  void operator()(ZSTD_CCtx* context) const { ZSTD_freeCCtx(context); }
  void operator()(ZSTD_DCtx* context) const { ZSTD_freeDCtx(context); }
};

// One context a thread: making one costs more than a block. Without memory for one both throw, and
// try again at the next call.
ZSTD_CCtx* compressor()
{
  thread_local std::unique_ptr<ZSTD_CCtx, FreeZstd> context;
  if (!context)
  {
    context.reset(ZSTD_createCCtx());
  }
  return context ? context.get() : throw std::bad_alloc();
}

ZSTD_DCtx* decompressor()
{
  thread_local std::unique_ptr<ZSTD_DCtx, FreeZstd> context;
  if (!context)
  {
    context.reset(ZSTD_createDCtx());
  }
  return context ? context.get() : throw std::bad_alloc();
}

/// Zstandard's answer where it finds no memory is no fault of the bytes.
std::size_t withMemory(std::size_t answer)
{
  return ZSTD_getErrorCode(answer) == ZSTD_error_memory_allocation ? throw std::bad_alloc()
                                                                   : answer;
}

// Reused by every block of a thread: planes before and after Zstandard.
std::vector<std::byte>& scratch(std::size_t size)
{
  thread_local std::vector<std::byte> bytes;
  if (bytes.size() < size)
  {
    bytes.resize(size);
  }
  return bytes;
}

// Plane b of component c holds byte b of every point's code, one after another.
template <typename T>
void toPlanes(const std::byte* values, const BlockShape& shape, std::byte* planes)
{
  for (unsigned c = 0; c < shape.components; ++c)
  {
    std::byte* plane = planes + std::size_t(c) * sizeof(T) * shape.points;
    T before = 0;
    for (std::size_t i = 0; i < shape.points; ++i)
    {
      T value;
      std::memcpy(&value, values + (i * shape.components + c) * sizeof(T), sizeof(T));
      const T code = zigzag(static_cast<T>(value - before));
      before = value;
      for (std::size_t b = 0; b < sizeof(T); ++b)
      {
        plane[b * shape.points + i] = static_cast<std::byte>((code >> (8 * b)) & 0xff);
      }
    }
  }
}

template <typename T>
void fromPlanes(const std::byte* planes, const BlockShape& shape, std::byte* values)
{
  for (unsigned c = 0; c < shape.components; ++c)
  {
    const std::byte* plane = planes + std::size_t(c) * sizeof(T) * shape.points;
    T value = 0;
    for (std::size_t i = 0; i < shape.points; ++i)
    {
      T code = 0;
      for (std::size_t b = 0; b < sizeof(T); ++b)
      {
        code = static_cast<T>(code | static_cast<T>(T(plane[b * shape.points + i]) << (8 * b)));
      }
      value = static_cast<T>(value + unzigzag(code));
      std::memcpy(values + (i * shape.components + c) * sizeof(T), &value, sizeof(T));
    }
  }
}
} // namespace

void splitPlanes(const std::byte* values, const BlockShape& shape, std::byte* planes)
{
  withUnsigned(
    shape.scalarBytes, [&](auto zero) { toPlanes<decltype(zero)>(values, shape, planes); });
}

void joinPlanes(const std::byte* planes, const BlockShape& shape, std::byte* values)
{
  withUnsigned(
    shape.scalarBytes, [&](auto zero) { fromPlanes<decltype(zero)>(planes, shape, values); });
}

std::vector<std::byte> encodePlanes(const std::byte* values, const BlockShape& shape)
{
  std::vector<std::byte>& planes = scratch(shape.bytes());
  splitPlanes(values, shape, planes.data());
  std::vector<std::byte> coded(ZSTD_compressBound(shape.bytes()));
  const std::size_t size = withMemory(ZSTD_compressCCtx(
    compressor(), coded.data(), coded.size(), planes.data(), shape.bytes(), zstdLevel));
  assert(!ZSTD_isError(size));
  coded.resize(size);
  return coded;
}

bool decodePlanes(
  const std::byte* coded, std::size_t codedBytes, const BlockShape& shape, std::byte* values)
{
  std::vector<std::byte>& planes = scratch(shape.bytes());
  const std::size_t size = withMemory(
    ZSTD_decompressDCtx(decompressor(), planes.data(), shape.bytes(), coded, codedBytes));
  if (ZSTD_isError(size) || size != shape.bytes())
  {
    return false;
  }
  joinPlanes(planes.data(), shape, values);
  return true;
}
} // namespace pointfront
