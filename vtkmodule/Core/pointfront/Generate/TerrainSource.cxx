#include "pointfront/Generate/TerrainSource.h"

#include "pointfront/Generate/LatticeNoise.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::uint64_t tilePoints = 65536; // a chunk: 256 scan lines of 256 pulses
constexpr std::uint64_t linePoints = 256;
constexpr double tileSize = 80.0; // metres: 10.24 points a square metre
constexpr double stepSize = tileSize / static_cast<double>(linePoints);
constexpr double origin[3] = { 400000.0, 5600000.0, 0.0 };
constexpr double scale = 0.001;

enum Column
{
  Intensity,
  ReturnNumber,
  ReturnCount,
  Classification,
  ScannerChannel,
  ScanAngle,
  PointSourceId,
  GpsTime,
  Rgb
};

AttributeSchema surveySchema()
{
  AttributeSchema schema;
  schema.add({ "intensity", ScalarType::UInt16, 1 });
  schema.add({ "return_number", ScalarType::UInt8, 1 });
  schema.add({ "return_count", ScalarType::UInt8, 1 });
  schema.add({ "classification", ScalarType::UInt8, 1 });
  schema.add({ "scanner_channel", ScalarType::UInt8, 1 }); // LAS 1.4, whose angles have fractions
  schema.add({ "scan_angle", ScalarType::Float32, 1 });
  schema.add({ "point_source_id", ScalarType::UInt16, 1 });
  schema.add({ "gps_time", ScalarType::Float64, 1 });
  schema.add({ "rgb", ScalarType::UInt16, 3 });
  return schema;
}

std::uint16_t intensityOf(TerrainModel::Class objectClass, double grain)
{
  double base = 18000.0;
  switch (objectClass)
  {
    case TerrainModel::Water:
      base = 3000.0;
      break;
    case TerrainModel::Building:
      base = 26000.0;
      break;
    case TerrainModel::HighVegetation:
      base = 11000.0;
      break;
    case TerrainModel::LowVegetation:
    case TerrainModel::Ground:
      break;
  }
  return static_cast<std::uint16_t>(base * (0.7 + 0.6 * grain));
}

template <typename T>
void store(PointBatch& batch, Column column, std::size_t point, const T& value)
{
  std::memcpy(batch.columns[column].data() + point * sizeof(T), &value, sizeof(T));
}

/// On the grid, so that what is written is what was made.
double onGrid(double value)
{
  return std::round(value / scale) * scale;
}
} // namespace

TerrainSource::TerrainSource(std::uint64_t points, std::uint64_t seed)
  : seed_(seed)
  , model_(seed)
{
  const std::uint64_t tiles = std::max<std::uint64_t>(1, (points + tilePoints - 1) / tilePoints);
  tilesAlongStrip_ = static_cast<std::uint64_t>(std::ceil(std::sqrt(static_cast<double>(tiles))));
  const std::uint64_t strips = (tiles + tilesAlongStrip_ - 1) / tilesAlongStrip_;
  description_.path = "synthetic terrain, seed " + std::to_string(seed);
  description_.format = "synthetic terrain";
  description_.pointCount = points;
  description_.schema = surveySchema();
  description_.grid = QuantisationGrid{ glm::dvec3(scale), { origin[0], origin[1], origin[2] } };
  description_.declaredBounds.low = { origin[0], origin[1], 0.0 };
  description_.declaredBounds.high = { origin[0] + tileSize * static_cast<double>(strips),
    origin[1] + tileSize * static_cast<double>(tilesAlongStrip_), 200.0 };
}

std::uint64_t TerrainSource::chunkCount() const
{
  return (description_.pointCount + tilePoints - 1) / tilePoints;
}

std::uint64_t TerrainSource::chunkPoints(std::uint64_t chunk) const
{
  return std::min(tilePoints, description_.pointCount - chunk * tilePoints);
}

Result<void> TerrainSource::read(std::uint64_t chunk, PointBatch& batch) const
{
  batch.resize(chunkPoints(chunk), description_.schema);
  const std::uint64_t strip = chunk / tilesAlongStrip_;
  // The aircraft turns at the end of a strip and comes back.
  const std::uint64_t along = chunk % tilesAlongStrip_;
  const std::uint64_t row = strip % 2 == 0 ? along : tilesAlongStrip_ - 1 - along;
  for (std::size_t i = 0; i < batch.size(); ++i)
  {
    const std::uint64_t index = chunk * tilePoints + i;
    const std::uint64_t key = hashOf(seed_ ^ (index * 0x2545f4914f6cdd1dull));
    const std::uint64_t line = i / linePoints;
    const double across = static_cast<double>(i % linePoints) + unitOf(hashOf(key + 1));
    const double forward = static_cast<double>(line) + unitOf(hashOf(key + 2));
    const double x = static_cast<double>(strip) * tileSize + across * stepSize;
    const double y = static_cast<double>(row) * tileSize + forward * stepSize;
    const double grain = unitOf(hashOf(key + 3));
    const TerrainModel::Echo echo = model_.echoAt(x, y, unitOf(hashOf(key + 4)));
    // The scanner measures to about 2 cm.
    const double height = echo.height + 0.04 * (unitOf(hashOf(key + 5)) - 0.5);
    batch.positions[i] = { origin[0] + onGrid(x), origin[1] + onGrid(y), onGrid(height) };

    const glm::u8vec3 colour = model_.colourOf(echo, x, y, grain);
    const glm::u16vec3 rgb(colour.r * 257, colour.g * 257, colour.b * 257);
    const auto angle = static_cast<float>(
      std::round((across / static_cast<double>(linePoints) - 0.5) * 40.0 / 0.006) * 0.006);
    store(batch, Intensity, i, intensityOf(echo.objectClass, grain));
    store(batch, ReturnNumber, i, echo.returnNumber);
    store(batch, ReturnCount, i, echo.returnCount);
    store(batch, Classification, i, static_cast<std::uint8_t>(echo.objectClass));
    store(batch, ScannerChannel, i, std::uint8_t(0));
    store(batch, ScanAngle, i, angle);
    store(batch, PointSourceId, i, static_cast<std::uint16_t>(strip + 1));
    store(batch, GpsTime, i, 1.0e6 + static_cast<double>(index) * 2.0e-6);
    store(batch, Rgb, i, rgb);
  }
  return {};
}

} // namespace pointfront
