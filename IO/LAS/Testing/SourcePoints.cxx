#include "SourcePoints.h"

#include "LASFormat.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cstring>
#include <numeric>
#include <thread>

namespace pointfront::test
{
namespace
{
/// Copies a chunk's points behind the first `first` points of `all`.
void place(
  const PointBatch& chunk, const AttributeSchema& schema, std::uint64_t first, PointBatch& all)
{
  std::copy(chunk.positions.begin(), chunk.positions.end(),
    all.positions.begin() + static_cast<std::ptrdiff_t>(first));
  for (std::size_t c = 0; c < schema.size(); ++c)
  {
    std::copy(chunk.columns[c].begin(), chunk.columns[c].end(),
      all.columns[c].begin() + static_cast<std::ptrdiff_t>(first * schema[c].bytes()));
  }
}

/// Number of each chunk's first point, and the number of points behind the last.
std::vector<std::uint64_t> firstPoints(const PointSource& source)
{
  std::vector<std::uint64_t> first(source.chunkCount() + 1, 0);
  for (std::uint64_t chunk = 0; chunk < source.chunkCount(); ++chunk)
  {
    first[chunk + 1] = first[chunk] + source.chunkPoints(chunk);
  }
  return first;
}

double number(ScalarType type, const std::byte* from)
{
  return visitScalar(type,
    [from](auto value)
    {
      std::memcpy(&value, from, sizeof value);
      return static_cast<double>(value);
    });
}
} // namespace

PointBatch readAll(const PointSource& source)
{
  const AttributeSchema& schema = source.description().schema;
  const std::vector<std::uint64_t> first = firstPoints(source);
  PointBatch all;
  PointBatch chunk;
  all.resize(first.back(), schema);
  for (std::uint64_t i = 0; i < source.chunkCount(); ++i)
  {
    const Result<void> done = source.read(i, chunk);
    if (!done)
    {
      ADD_FAILURE() << done.error().what;
      break;
    }
    EXPECT_EQ(chunk.size(), source.chunkPoints(i));
    place(chunk, schema, first[i], all);
  }
  return all;
}

PointBatch readAllBackwards(const PointSource& source, int threads)
{
  const AttributeSchema& schema = source.description().schema;
  const std::vector<std::uint64_t> first = firstPoints(source);
  PointBatch all;
  all.resize(first.back(), schema);
  std::atomic<std::uint64_t> left{ source.chunkCount() };
  std::atomic<int> failures{ 0 };
  const auto work = [&]
  {
    PointBatch chunk;
    for (std::uint64_t taken = left.fetch_sub(1); taken > 0 && taken <= source.chunkCount();
         taken = left.fetch_sub(1))
    {
      const bool ok = source.read(taken - 1, chunk).ok();
      failures += ok ? 0 : 1;
      if (ok)
      {
        place(chunk, schema, first[taken - 1], all);
      }
    }
  };
  std::vector<std::thread> pool;
  for (int i = 0; i < threads; ++i)
  {
    pool.emplace_back(work);
  }
  for (std::thread& thread : pool)
  {
    thread.join();
  }
  EXPECT_EQ(failures, 0);
  return all;
}

std::unique_ptr<PointSource> openOrFail(const std::string& path)
{
  const LASFormat format;
  EXPECT_TRUE(format.accepts(path)) << path << " is missing, or is no LAS file";
  Result<std::unique_ptr<PointSource>> source = format.open(path);
  if (!source)
  {
    ADD_FAILURE() << source.error().what;
    return nullptr;
  }
  return std::move(*source);
}

std::vector<double> valuesOf(
  const PointBatch& batch, const AttributeSchema& schema, const char* name, int component)
{
  const std::optional<std::size_t> column = schema.find(name);
  if (!column)
  {
    ADD_FAILURE() << "no attribute " << name;
    return {};
  }
  const Attribute& attribute = schema[*column];
  const std::byte* from =
    batch.columns[*column].data() + static_cast<std::size_t>(component) * sizeOf(attribute.type);
  std::vector<double> values(batch.size());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    values[i] = number(attribute.type, from + i * attribute.bytes());
  }
  return values;
}

std::string classHistogram(const PointBatch& batch, const AttributeSchema& schema)
{
  std::map<int, int> histogram;
  for (const double value : valuesOf(batch, schema, "classification"))
  {
    ++histogram[static_cast<int>(value)];
  }
  std::string text;
  for (const auto& [value, count] : histogram)
  {
    text += (text.empty() ? "" : " ") + std::to_string(value) + ":" + std::to_string(count);
  }
  return text;
}

} // namespace pointfront::test
