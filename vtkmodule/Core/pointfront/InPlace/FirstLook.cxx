#include "pointfront/InPlace/FirstLook.h"

#include "pointfront/Ingest/GridChoice.h"
#include "pointfront/InPlace/ForeignTree.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <utility>

namespace pointfront
{
namespace
{

/// All points in the memory of this process.
class HeldPoints final : public ForeignNodes
{
public:
  HeldPoints(PointBatch points, std::vector<std::string> files)
    : points_(std::move(points))
    , files_(std::move(files))
  {
  }
  Result<RawBytes> fetch(const ForeignNode&) const override { return RawBytes(0); }
  std::size_t storedBytes(const ForeignNode&) const override { return 0; }
  Result<void> decode(const Part&, const RawBytes&, PointBatch& batch) const override
  {
    batch = points_;
    return {};
  }
  std::vector<std::string> files() const override { return files_; }

private:
  PointBatch points_;
  std::vector<std::string> files_;
};

double spacingOf(const Bounds& bounds, std::size_t points)
{
  const glm::dvec3 size = bounds.size();
  const double area = std::max({ size.x * size.y, size.x * size.z, size.y * size.z });
  return std::sqrt(area / static_cast<double>(points));
}

std::uint64_t bytesOf(const std::vector<std::string>& files)
{
  std::uint64_t sum = 0;
  for (const std::string& file : files)
  {
    std::error_code failure;
    const std::uintmax_t bytes = std::filesystem::file_size(file, failure);
    sum += failure ? 0 : bytes;
  }
  return sum;
}

bool isPlace(const glm::dvec3& p)
{
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
}

/// Takes points without a place out of the batch.
void leaveOutNonPlaces(PointBatch& batch, const AttributeSchema& schema)
{
  std::size_t kept = 0;
  for (std::size_t i = 0; i < batch.positions.size(); ++i)
  {
    if (!isPlace(batch.positions[i]))
    {
      continue;
    }
    batch.positions[kept] = batch.positions[i];
    for (std::size_t c = 0; c < schema.size(); ++c)
    {
      const auto bytes = static_cast<std::ptrdiff_t>(schema[c].bytes());
      const auto column = batch.columns[c].begin();
      std::copy_n(column + static_cast<std::ptrdiff_t>(i) * bytes, bytes,
        column + static_cast<std::ptrdiff_t>(kept) * bytes);
    }
    ++kept;
  }
  batch.resize(kept, schema);
}

} // namespace

Result<std::shared_ptr<const StoredCloud>> cloudOfPoints(
  SourceDescription source, PointBatch points, std::vector<std::string> files)
{
  source.declaredBounds = Bounds();
  for (const glm::dvec3& p : points.positions)
  {
    source.declaredBounds.add(p);
  }
  ForeignTreeContent content;
  content.source = std::move(source);
  content.fileBytes = bytesOf(files);
  const glm::dvec3 step = content.source.grid->scale;
  content.setCube(content.source.declaredBounds);
  content.side = std::max({ content.side, step.x, step.y, step.z });
  content.spacing = spacingOf(content.source.declaredBounds, points.size());
  ForeignNode root;
  root.points = static_cast<std::uint32_t>(points.size());
  content.first.nodes = { root };
  content.reader = std::make_shared<const HeldPoints>(std::move(points), std::move(files));
  return ForeignTree::make(std::move(content));
}

Result<std::shared_ptr<const StoredCloud>> firstLookAt(std::unique_ptr<PointSource> source)
{
  constexpr std::uint64_t mostChunks = 16;
  constexpr std::size_t mostPoints = std::size_t(1) << 20;
  SourceDescription description = source->description();
  const std::uint64_t chunks = source->chunkCount();
  const std::uint64_t wanted = std::min(chunks, mostChunks);
  PointBatch points;
  PointBatch chunk;
  for (std::uint64_t i = 0; i < wanted && points.size() < mostPoints; ++i)
  {
    if (Result<void> read = source->read(i * chunks / wanted, chunk); !read)
    {
      return read.error();
    }
    leaveOutNonPlaces(chunk, description.schema);
    points.append(chunk);
  }
  if (points.size() == 0)
  {
    return makeError(Error::Kind::NotFound, description.path + ": the file holds no points");
  }
  if (points.size() > mostPoints)
  {
    points.resize(mostPoints, description.schema);
  }
  if (points.size() < description.pointCount)
  {
    description.warnings.push_back("A first look: " + std::to_string(points.size()) + " of " +
      std::to_string(description.pointCount) + " points; build a store of them to see all.");
  }
  std::vector<std::string> files = description.furtherFiles;
  files.insert(files.begin(), description.path);
  std::vector<std::unique_ptr<PointSource>> sources;
  sources.push_back(std::move(source));
  const Result<GridChoice> grid = chooseGrid(sources, std::nullopt);
  if (!grid)
  {
    return grid.error();
  }
  description.grid = grid->grid;
  return cloudOfPoints(std::move(description), std::move(points), std::move(files));
}

} // namespace pointfront
