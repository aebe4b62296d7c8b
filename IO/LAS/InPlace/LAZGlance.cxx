#include "LAZGlance.h"

#include "LASFile.h"
#include "LASPointDecoder.h"
#include "LAZChunkTable.h"
#include "LAZCompression.h"

#include "pointfront/Base/LetterCase.h"
#include "pointfront/Ingest/CommonSchema.h"
#include "pointfront/Ingest/GridChoice.h"
#include "pointfront/Ingest/ReferenceSystem.h"
#include "pointfront/InPlace/FirstLook.h"
#include "pointfront/Points/AttributePass.h"
#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <filesystem>
#include <optional>
#include <utility>

namespace pointfront
{
namespace
{
namespace fs = std::filesystem;

constexpr std::uint64_t pointsApart = 50000; ///< in LAS files: as the chunks of LAZ

/// The part that was taken of one file.
class GlancedFile final : public PointSource
{
public:
  GlancedFile(SourceDescription description, PointBatch points)
    : description_(std::move(description))
    , points_(std::move(points))
  {
  }
  const PointBatch& points() const { return points_; }
  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return 1; }
  std::uint64_t chunkPoints(std::uint64_t) const override { return points_.size(); }
  Result<void> read(std::uint64_t, PointBatch& batch) const override
  {
    batch = points_;
    return {};
  }

private:
  SourceDescription description_;
  PointBatch points_;
};

/// Byte offsets of records that lie in the file as they are.
Result<std::vector<std::uint64_t>> plainRecords(LASFile& file)
{
  std::vector<std::uint64_t> offsets;
  if (!file.header.compressed)
  {
    if (Result<void> counted = file.countRecords(); !counted)
    {
      return counted.error();
    }
    for (std::uint64_t i = 0; i < file.description.pointCount; i += pointsApart)
    {
      offsets.push_back(file.header.pointOffset + i * file.header.pointBytes);
    }
    return offsets;
  }
  const Result<LAZCompression> compression = LAZCompression::of(file);
  if (!compression)
  {
    return compression.error();
  }
  const Result<std::vector<LAZChunk>> chunks =
    findLAZChunks(file, *compression, file.description.warnings);
  if (!chunks)
  {
    return chunks.error();
  }
  for (const LAZChunk& chunk : *chunks)
  {
    if (chunk.offset + file.header.pointBytes <= file.map.size())
    {
      offsets.push_back(chunk.offset);
    }
  }
  return offsets;
}

Result<std::unique_ptr<PointSource>> glanceAt(const std::string& path, std::size_t mostPoints)
{
  Result<LASFile> file = LASFile::open(path, MemoryMap::Access::Random);
  if (!file)
  {
    return file.error();
  }
  if (file->far)
  {
    return makeError(Error::Kind::Unsupported,
      "'" + path +
        "' is no COPC file, so all of it would be read from afar; build a store from a copy, or "
        "write it as COPC");
  }
  const Result<std::vector<std::uint64_t>> offsets = plainRecords(*file);
  if (!offsets)
  {
    return offsets.error();
  }
  const std::size_t step = 1 + offsets->size() / std::max<std::size_t>(1, mostPoints);
  PointBatch points;
  points.resize((offsets->size() + step - 1) / step, file->layout.schema);
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    decodeLASPoints(
      file->layout, file->header.grid, file->bytes().data + (*offsets)[i * step], 1, points, i);
  }
  if (Result<void> whole = file->map.checkWhole(); !whole)
  {
    return whole.error();
  }
  SourceDescription description = file->description;
  description.declaredBounds = Bounds();
  for (const glm::dvec3& p : points.positions)
  {
    description.declaredBounds.add(p);
  }
  return std::unique_ptr<PointSource>(
    std::make_unique<GlancedFile>(std::move(description), std::move(points)));
}

/// The points of all files in the columns of all.
PointBatch joined(const PointSources& files, const CommonSchema& common)
{
  PointBatch all;
  all.columns.resize(common.schema.size());
  for (std::size_t f = 0; f < files.size(); ++f)
  {
    const PointBatch& own = static_cast<const GlancedFile&>(*files[f]).points();
    const AttributeSchema& schema = files[f]->description().schema;
    all.positions.insert(all.positions.end(), own.positions.begin(), own.positions.end());
    for (std::size_t c = 0; c < common.schema.size(); ++c)
    {
      const Attribute& attribute = common.schema[c];
      const ColumnMapping& mapping = common.mappings[f][c];
      std::vector<std::byte> values(own.size() * attribute.bytes());
      if (mapping.column && mapping.converted)
      {
        convertColumn(schema[*mapping.column], own.columns[*mapping.column].data(), attribute,
          values.data(), own.size());
      }
      else if (mapping.column)
      {
        values = own.columns[*mapping.column];
      }
      all.columns[c].insert(all.columns[c].end(), values.begin(), values.end());
    }
  }
  return all;
}

Result<PointSources> glanceAtAll(
  const std::string& path, const std::vector<std::string>& files, std::size_t mostPoints)
{
  std::vector<Result<std::unique_ptr<PointSource>>> glances;
  for (std::size_t i = 0; i < files.size(); ++i)
  {
    glances.emplace_back(makeError(Error::Kind::NotFound, files[i]));
  }
  const std::size_t each = std::max<std::size_t>(1, mostPoints / files.size());
  ThreadCrew::ofProcess().run(
    files.size(), [&](std::size_t i, unsigned) { glances[i] = glanceAt(files[i], each); });
  PointSources sources;
  std::size_t faulty = 0;
  std::optional<Error> first;
  for (auto& glance : glances)
  {
    if (!glance)
    {
      ++faulty;
      first = first ? first : glance.error();
      continue;
    }
    sources.push_back(std::move(*glance));
  }
  if (faulty > 0)
  {
    return makeError(first->kind,
      path + ": " + std::to_string(faulty) + " of " + std::to_string(files.size()) +
        " files cannot be looked at: " + first->what);
  }
  return sources;
}

Result<std::vector<std::string>> lasFilesBelow(const std::string& folder)
{
  std::vector<std::string> files;
  std::error_code failure;
  fs::recursive_directory_iterator entry(folder, failure);
  for (; !failure && entry != fs::recursive_directory_iterator(); entry.increment(failure))
  {
    std::error_code vanished;
    const std::string extension = loweredExtension(entry->path().string());
    if ((extension == ".las" || extension == ".laz") && entry->is_regular_file(vanished))
    {
      files.push_back(entry->path().string());
    }
  }
  if (failure)
  {
    return makeError(
      Error::Kind::Unreadable, folder + ": cannot list the folder: " + failure.message());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// Describes files whose points are `points` in the columns `schema`; warnings say what is missing.
SourceDescription describeGlances(
  const PointSources& glances, const PointBatch& points, const AttributeSchema& schema)
{
  const SourceDescription& first = glances.front()->description();
  SourceDescription source;
  source.format = "glance at " + first.format;
  source.schema = schema;
  source.crsWkt = first.crsWkt;
  source.metadata = first.metadata;
  std::uint64_t all = 0;
  for (const auto& glance : glances)
  {
    all += glance->description().pointCount;
  }
  source.headerPointCount = all;
  source.warnings.push_back("A first look: " + std::to_string(points.size()) + " of " +
    std::to_string(all) + " points, one of each chunk of " + std::to_string(glances.size()) +
    " files; build a store of them to see all.");
  if (const Result<ReferenceSystem> system = commonReferenceSystem(glances); !system)
  {
    source.warnings.push_back(system.error().what + ".");
  }
  return source;
}

} // namespace

Result<std::shared_ptr<const StoredCloud>> glanceAtLAS(
  const std::string& path, const std::vector<std::string>& files, std::size_t mostPoints)
{
  if (files.empty())
  {
    return makeError(Error::Kind::NotFound, path + ": holds no LAS or LAZ file");
  }
  const Result<PointSources> glances = glanceAtAll(path, files, mostPoints);
  if (!glances)
  {
    return glances.error();
  }
  const Result<CommonSchema> common = commonSchema(*glances, std::nullopt);
  const Result<GridChoice> grid = chooseGrid(*glances, std::nullopt);
  if (!common || !grid)
  {
    return !common ? common.error() : grid.error();
  }
  PointBatch points = joined(*glances, *common);
  if (points.size() == 0)
  {
    return makeError(Error::Kind::NotFound, path + ": its files hold no points");
  }
  SourceDescription source = describeGlances(*glances, points, common->schema);
  source.path = path;
  source.grid = grid->grid;
  return cloudOfPoints(std::move(source), std::move(points), files);
}

bool LAZGlanceFormat::accepts(const std::string& path) const
{
  std::error_code failure;
  if (!fs::is_directory(path, failure) || fs::exists(fs::path(path) / "ept.json", failure))
  {
    return false;
  }
  const Result<std::vector<std::string>> files = lasFilesBelow(path);
  return files && !files->empty();
}

Result<std::shared_ptr<const StoredCloud>> LAZGlanceFormat::open(const std::string& path) const
{
  const Result<std::vector<std::string>> files = lasFilesBelow(path);
  return files ? glanceAtLAS(path, *files) : files.error();
}

} // namespace pointfront
