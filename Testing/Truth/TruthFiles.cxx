#include "TruthFiles.h"

#include "PLYWriter.h"
#include "PNGWriter.h"

#include "pointfront/Disk/OutputFile.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstring>

namespace pointfront::truth
{
namespace
{
constexpr std::size_t batchPoints = 1u << 16;

Result<void> writeBytes(const std::string& path, const void* bytes, std::size_t size)
{
  Result<std::unique_ptr<OutputFile>> file = OutputFile::create(path, OutputFile::Durability::None);
  if (!file)
  {
    return file.error();
  }
  Result<void> done = (*file)->append(static_cast<const std::byte*>(bytes), size);
  return done ? (*file)->publish() : done;
}

Result<void> writeJson(const std::string& path, const nlohmann::ordered_json& object)
{
  const std::string text = object.dump(2) + "\n";
  return writeBytes(path, text.data(), text.size());
}

nlohmann::ordered_json jsonOf(const glm::dvec3& place)
{
  return { place.x, place.y, place.z };
}
} // namespace

Result<void> writePoints(const std::string& path, const TruthPoints& points)
{
  SinkDescription description;
  description.schema.add({ "rgb", ScalarType::UInt8, 3 });
  description.schema.add({ "normal", ScalarType::Float32, 3 });
  description.pointCount = points.size();
  PLYWriter writer(path);
  if (Result<void> done = writer.begin(description); !done)
  {
    return done;
  }
  PointBatch batch;
  for (std::size_t first = 0; first < points.size(); first += batchPoints)
  {
    const std::size_t count = std::min(batchPoints, points.size() - first);
    batch.resize(count, description.schema);
    std::copy_n(points.positions.data() + first, count, batch.positions.data());
    std::memcpy(batch.columns[0].data(), points.colours.data() + first, 3 * count);
    std::memcpy(batch.columns[1].data(), points.normals.data() + first, sizeof(glm::vec3) * count);
    if (Result<void> done = writer.append(batch); !done)
    {
      return done;
    }
  }
  return writer.finish();
}

Result<void> writePicture(const std::string& path, const Picture& picture)
{
  std::vector<std::uint8_t> rgb;
  rgb.reserve(3 * picture.pixels());
  for (std::size_t i = 0; i < picture.pixels(); ++i)
  {
    const std::uint8_t* pixel = picture.rgba.data() + 4 * i;
    rgb.insert(rgb.end(), pixel, pixel + 3);
  }
  auto writer = PNGWriter::create(path, { picture.width, picture.height }, PNGWriter::Pixels::RGB8);
  if (!writer)
  {
    return writer.error();
  }
  const auto stride = std::ptrdiff_t(3) * picture.width;
  Result<void> done = (*writer)->append(rgb.data(), picture.height, stride);
  return done ? (*writer)->finish() : done;
}

Result<void> writeDepth(const std::string& path, const std::vector<float>& depth)
{
  return writeBytes(path, depth.data(), depth.size() * sizeof(float));
}

Result<void> writeCamera(const std::string& path, const TruthCamera& camera)
{
  nlohmann::ordered_json object;
  object["position"] = jsonOf(camera.position);
  object["focal_point"] = jsonOf(camera.focalPoint);
  object["view_up"] = jsonOf(camera.viewUp);
  object["view_angle"] = camera.viewAngleDegrees;
  return writeJson(path, object);
}

Result<void> writeFacts(const std::string& path, const PixelRays& pixels, const SpacingGrade& grade,
  const TruthPoints& points)
{
  nlohmann::ordered_json object;
  object["width"] = pixels.width();
  object["height"] = pixels.height();
  object["points"] = points.size();
  object["spacing_px"] = grade.spacing * pixels.focalPx() / grade.medianDepth;
  object["spacing"] = grade.spacing;
  object["median_depth"] = grade.medianDepth;
  object["graded"] = grade.graded;
  object["focal_px"] = pixels.focalPx();
  object["background"] = background;
  return writeJson(path, object);
}

} // namespace pointfront::truth
