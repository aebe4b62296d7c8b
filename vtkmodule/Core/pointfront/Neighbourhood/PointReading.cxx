#include "pointfront/Neighbourhood/PointReading.h"

#include "pointfront/Ingest/CommonSchema.h"

#include <cstring>

namespace pointfront
{

void readClasses(
  const AttributeSchema& schema, const PointBatch& batch, std::vector<std::uint8_t>& classes)
{
  classes.assign(batch.size(), 0);
  const auto column = schema.find("classification");
  if (!column || schema[*column].components != 1)
  {
    return;
  }
  const Attribute& attribute = schema[*column];
  if (attribute.type == ScalarType::UInt8)
  {
    std::memcpy(classes.data(), batch.columns[*column].data(), batch.size());
    return;
  }
  const Attribute wide{ attribute.name, ScalarType::Float64, 1, attribute.scale, attribute.offset };
  std::vector<double> values(batch.size());
  convertColumn(attribute, batch.columns[*column].data(), wide,
    reinterpret_cast<std::byte*>(values.data()), batch.size());
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    const double code = values[i] * attribute.scale + attribute.offset;
    classes[i] = code >= 0.0 && code < 256.0 ? static_cast<std::uint8_t>(code) : std::uint8_t(0);
  }
}

PointReading::PointReading(
  const PointSources& sources, const InputOrder& order, const ClassSet& classes)
  : sources_(sources)
  , order_(order)
  , classes_(classes)
{
}

Result<bool> PointReading::next(Chunk& chunk)
{
  const std::uint64_t number = next_++;
  if (number >= order_.chunks())
  {
    return false;
  }
  const SourceChunk place = order_.chunk(number);
  const PointSource& source = *sources_[place.source];
  if (Result<void> done = source.read(place.chunk, chunk.batch); !done)
  {
    return done.error();
  }
  chunk.read = chunk.batch.size();
  if (chunk.read > source.chunkPoints(place.chunk))
  {
    return makeError(Error::Kind::BadFormat,
      "'" + source.description().path + "' gave more points than it announced");
  }
  thread_local std::vector<std::uint8_t> classes;
  readClasses(source.description().schema, chunk.batch, classes);
  const std::uint64_t first = order_.first(place);
  chunk.points.clear();
  for (std::size_t i = 0; i < chunk.batch.size(); ++i)
  {
    const glm::dvec3& p = chunk.batch.positions[i];
    if (classes_[classes[i]] && hasPlace(p))
    {
      chunk.points.push_back({ p, TilePoint::keyOf(first + i, classes[i]) });
    }
  }
  return true;
}

} // namespace pointfront
