#include "pointfront/Codec/PackedCodec.h"
#include "pointfront/Codec/PackedGroupWriter.h"
#include "pointfront/Codec/PackedPredictor.h"
#include "pointfront/Codec/ValueCode.h"

#include <algorithm>
#include <cstring>
#include <numeric>

namespace pointfront
{
namespace
{
/// The values of a block with each component in one piece, so that loops over them become vectors.
/// One instance a thread and type, reused: fresh memory costs more than the copy.
template <typename T>
class ComponentPlanes
{
public:
  void take(const std::byte* values, const BlockShape& shape)
  {
    points_ = shape.points;
    components_ = shape.components;
    const std::size_t needed = components_ * stride();
    if (values_.size() < needed)
    {
      values_.resize(needed);
    }
    for (unsigned c = 0; c < components_; ++c)
    {
      plane(c)[-1] = 0; // the point before the first
    }
    if (components_ == 1)
    {
      std::memcpy(plane(0), values, shape.bytes());
    }
    else if (components_ == 3)
    {
      takeThree(values, shape.points);
    }
    else
    {
      takeAny(values, shape);
    }
  }

  std::size_t points() const { return points_; }
  unsigned components() const { return components_; }
  const T* plane(unsigned c) const { return values_.data() + c * stride() + 1; }
  T* plane(unsigned c) { return values_.data() + c * stride() + 1; }

  /// The factor that all values have; 0 when all are zero. Colours of 8 bits that were stretched
  /// to 16, coordinates of a scale finer than their instrument, doubles that once were floats.
  T commonFactor() const
  {
    T factor = 0;
    for (unsigned c = 0; c < components_; ++c)
    {
      const T* values = plane(c);
      for (std::size_t i = 0; i < points_ && factor != 1; ++i)
      {
        factor = std::gcd(factor, values[i]);
      }
    }
    return factor;
  }

  void divide(T factor)
  {
    for (unsigned c = 0; c < components_; ++c)
    {
      T* values = plane(c);
      for (std::size_t i = 0, count = points_; i < count; ++i)
      {
        values[i] = static_cast<T>(values[i] / factor);
      }
    }
  }

  /// Component 1 subtracted from 0 and 2 (-1) or added again (+1), modulo 2^bits.
  void addSecond(int sign)
  {
    const T* second = plane(1);
    for (const unsigned c : { 0u, 2u })
    {
      T* values = plane(c);
      for (std::size_t i = 0, count = points_; i < count; ++i)
      {
        values[i] = static_cast<T>(sign < 0 ? values[i] - second[i] : values[i] + second[i]);
      }
    }
  }

private:
  std::size_t stride() const { return points_ + 1; }

  void takeAny(const std::byte* values, const BlockShape& shape)
  {
    for (unsigned c = 0; c < shape.components; ++c)
    {
      T* to = plane(c);
      for (std::size_t i = 0; i < shape.points; ++i)
      {
        std::memcpy(to + i, values + (i * shape.components + c) * sizeof(T), sizeof(T));
      }
    }
  }

  void takeThree(const std::byte* values, std::size_t points)
  {
    T* x = plane(0);
    T* y = plane(1);
    T* z = plane(2);
    for (std::size_t i = 0; i < points; ++i, values += 3 * sizeof(T))
    {
      std::memcpy(x + i, values, sizeof(T));
      std::memcpy(y + i, values + sizeof(T), sizeof(T));
      std::memcpy(z + i, values + 2 * sizeof(T), sizeof(T));
    }
  }

  std::vector<T> values_;
  std::size_t points_ = 0;
  unsigned components_ = 1;
};

/// Not inlined: the address of what is the thread's own is looked up once.
template <typename T>
[[gnu::noinline]] ComponentPlanes<T>& planesOfThread()
{
  thread_local ComponentPlanes<T> planes;
  return planes;
}

/// Codes of the points from `begin` on; those beyond the last point are 0.
template <typename T>
void codesOf(const ComponentPlanes<T>& planes, std::size_t begin, unsigned c, bool difference,
  CodeGroup<T>& codes)
{
  const T* values = planes.plane(c) + begin;
  const T* before = values - 1;
  const std::size_t count = std::min(codesPerGroup, planes.points() - begin);
  if (!difference)
  {
    std::copy(values, values + count, codes.begin());
  }
  else if (count < codesPerGroup)
  {
    for (std::size_t i = 0; i < count; ++i)
    {
      codes[i] = zigzag(static_cast<T>(values[i] - before[i]));
    }
  }
  else
  {
    for (std::size_t i = 0; i < codesPerGroup; ++i) // a fixed number: vectors without a rest
    {
      codes[i] = zigzag(static_cast<T>(values[i] - before[i]));
    }
  }
  std::fill(codes.begin() + static_cast<std::ptrdiff_t>(count), codes.end(), T(0));
}

/// Bytes of the groups from the group of point `begin` on; any number above `most` for more.
template <typename T>
std::size_t groupsBytes(
  const ComponentPlanes<T>& planes, std::size_t begin, bool difference, std::size_t most = SIZE_MAX)
{
  std::size_t sum = 0;
  CodeGroup<T> codes;
  for (; begin < planes.points() && sum <= most; begin += codesPerGroup)
  {
    for (unsigned c = 0; c < planes.components(); ++c)
    {
      codesOf<T>(planes, begin, c, difference, codes);
      sum += groupBytes<T>(codes);
    }
  }
  return sum;
}

/// The choice of predictors that the last points of a block speak for.
struct PredictorChoice
{
  Predictor predictor = Predictor::Zero;
  std::size_t sampleBytes = 0;
};

/// Leaves the planes as the chosen predictor wants them.
template <typename T>
PredictorChoice choosePredictor(ComponentPlanes<T>& planes, const BlockShape& shape)
{
  const std::size_t skipped = shape.points - sampleOf(shape).points;
  const std::size_t begin = skipped - skipped % codesPerGroup;
  PredictorChoice best{ Predictor::PointBefore, groupsBytes(planes, begin, true) };
  if (const std::size_t bytes = groupsBytes(planes, begin, false, best.sampleBytes);
      bytes <= best.sampleBytes)
  {
    best = { Predictor::Zero, bytes };
  }
  if (predictable(Predictor::SecondComponent, shape))
  {
    planes.addSecond(-1);
    if (const std::size_t bytes = groupsBytes(planes, begin, true, best.sampleBytes);
        bytes < best.sampleBytes)
    {
      return { Predictor::SecondComponent, bytes };
    }
    planes.addSecond(1);
  }
  return best;
}

template <typename T>
std::vector<std::byte> encodeGroups(const ComponentPlanes<T>& planes, Predictor predictor, T factor)
{
  thread_local std::vector<std::byte> scratch; // likewise: written once, then cut to its length
  const std::size_t groups = (planes.points() + codesPerGroup - 1) / codesPerGroup;
  const std::size_t most = 1 + sizeof(T) +
    groups * planes.components() * packed::mostGroupBytes<T> + packed::writtenBeyond;
  if (scratch.size() < most)
  {
    scratch.resize(most);
  }
  std::byte* at = scratch.data();
  *at++ = static_cast<std::byte>(predictor) | (factor > 1 ? factorFlag : std::byte(0));
  if (factor > 1)
  {
    std::memcpy(at, &factor, sizeof(T));
    at += sizeof(T);
  }
  CodeGroup<T> codes;
  for (std::size_t begin = 0; begin < planes.points(); begin += codesPerGroup)
  {
    for (unsigned c = 0; c < planes.components(); ++c)
    {
      codesOf<T>(planes, begin, c, predictor != Predictor::Zero, codes);
      at = putGroup<T>(codes, at);
    }
  }
  return { scratch.data(), at };
}
} // namespace

PackedBlock packBlock(const std::byte* values, const BlockShape& shape)
{
  return withUnsigned(shape.scalarBytes,
    [&](auto zero)
    {
      using T = decltype(zero);
      ComponentPlanes<T>& planes = planesOfThread<T>();
      planes.take(values, shape);
      const T factor = planes.commonFactor();
      if (factor > 1)
      {
        planes.divide(factor);
      }
      const PredictorChoice choice = choosePredictor<T>(planes, shape);
      return PackedBlock{ encodeGroups<T>(planes, choice.predictor, factor), choice.sampleBytes };
    });
}

std::vector<std::byte> encodePacked(const std::byte* values, const BlockShape& shape)
{
  return packBlock(values, shape).bytes;
}

} // namespace pointfront
