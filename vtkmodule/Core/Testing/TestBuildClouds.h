#pragma once

#include "pointfront/Build/StoreBuilder.h"
#include "pointfront/Points/PointSource.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <unistd.h>

namespace pointfront::test
{

/// A folder of this process alone: the suite may run several times at once.
inline std::filesystem::path freshFolder(const std::string& name)
{
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) /
    ("pointfront-" + name + "-" + std::to_string(getpid()));
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  return folder;
}

/// A cloud in memory, as a source of `chunk` points a chunk.
class CloudSource final : public PointSource
{
public:
  CloudSource(std::string path, AttributeSchema schema, std::optional<QuantisationGrid> grid,
    std::uint64_t chunk = 1000)
    : chunk_(chunk)
  {
    description_.path = std::move(path);
    description_.format = "test";
    description_.schema = std::move(schema);
    description_.grid = grid;
    columns_.resize(description_.schema.size());
  }

  /// Appends a point; values() follow in the order of the columns.
  void addPosition(const glm::dvec3& position)
  {
    positions_.push_back(position);
    description_.pointCount = positions_.size();
    description_.declaredBounds.add(position);
  }
  template <typename T>
  void addValue(std::size_t column, const T& value)
  {
    const auto* bytes = reinterpret_cast<const std::byte*>(&value);
    columns_[column].insert(columns_[column].end(), bytes, bytes + sizeof(T));
  }

  SourceDescription& editDescription() { return description_; }
  void failAt(std::uint64_t chunk) { failAt_ = chunk; }
  const std::vector<glm::dvec3>& positions() const { return positions_; }
  const std::vector<std::byte>& column(std::size_t c) const { return columns_[c]; }

  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return (positions_.size() + chunk_ - 1) / chunk_; }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override
  {
    return std::min<std::uint64_t>(chunk_, positions_.size() - chunk * chunk_);
  }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    if (failAt_ == chunk)
    {
      return makeError(Error::Kind::Truncated, "'" + description_.path + "' ends at byte 4711");
    }
    const std::size_t first = chunk * chunk_;
    const std::size_t count = chunkPoints(chunk);
    batch.resize(count, description_.schema);
    std::copy_n(
      positions_.begin() + static_cast<std::ptrdiff_t>(first), count, batch.positions.begin());
    for (std::size_t c = 0; c < columns_.size(); ++c)
    {
      const std::size_t bytes = description_.schema[c].bytes();
      std::copy_n(columns_[c].begin() + static_cast<std::ptrdiff_t>(first * bytes), count * bytes,
        batch.columns[c].begin());
    }
    return {};
  }

private:
  std::uint64_t chunk_;
  SourceDescription description_;
  std::vector<glm::dvec3> positions_;
  std::vector<std::vector<std::byte>> columns_;
  std::optional<std::uint64_t> failAt_;
};

/// A small generator with a fixed meaning on every platform (SplitMix64).
class Random
{
public:
  explicit Random(std::uint64_t seed)
    : state_(seed)
  {
  }
  std::uint64_t next()
  {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ull);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    return z ^ (z >> 31);
  }
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; } ///< 0 to 1

private:
  std::uint64_t state_;
};

inline QuantisationGrid millimetres(const glm::dvec3& offset = glm::dvec3(0.0))
{
  return { glm::dvec3(0.001), offset };
}

/// Schema of cloudOf(): "id" is the input index, so that every point can be told from the others.
inline AttributeSchema idSchema()
{
  AttributeSchema schema;
  schema.add({ "id", ScalarType::UInt32, 1 });
  schema.add({ "intensity", ScalarType::UInt16, 1 });
  return schema;
}

inline std::unique_ptr<CloudSource> cloudOf(std::size_t count, const QuantisationGrid& grid,
  const std::function<GridPosition(std::size_t)>& position, std::uint64_t chunk = 1000)
{
  auto cloud = std::make_unique<CloudSource>("cloud", idSchema(), grid, chunk);
  for (std::size_t i = 0; i < count; ++i)
  {
    cloud->addPosition(grid.toWorld(position(i)));
    cloud->addValue(0, static_cast<std::uint32_t>(i));
    cloud->addValue(1, static_cast<std::uint16_t>(i * 7));
  }
  return cloud;
}

/// Gentle hills of `side` steps a side: what an airborne survey looks like to an octree.
inline std::unique_ptr<CloudSource> hills(std::size_t count, double side,
  const QuantisationGrid& grid = millimetres(), std::uint64_t chunk = 1000)
{
  auto random = std::make_shared<Random>(20);
  return cloudOf(
    count, grid,
    [=](std::size_t) -> GridPosition
    {
      const double x = random->uniform();
      const double y = random->uniform();
      const double z = 0.05 * std::sin(9.0 * x) * std::cos(7.0 * y);
      return { std::llround(side * x), std::llround(side * y), std::llround(side * z) };
    },
    chunk);
}

inline std::vector<std::unique_ptr<PointSource>> one(std::unique_ptr<CloudSource> source)
{
  std::vector<std::unique_ptr<PointSource>> sources;
  sources.push_back(std::move(source));
  return sources;
}

} // namespace pointfront::test
