#include "IndexedNormals.h"

#include "LASSource.h"

#include "pointfront/Codec/Checksum.h"
#include "pointfront/InPlace/NodePoints.h"
#include "pointfront/Neighbourhood/InputOrder.h"
#include "pointfront/Points/NormalAttribute.h"
#include "pointfront/Store/ColumnStatistics.h"
#include "pointfront/Threads/WorkCrew.h"

#include <atomic>
#include <mutex>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::size_t normalBytes = sizeof(PackedNormal);
constexpr double passShare = 0.5; ///< share of the progress; the other half reads the pass's values

Result<PointSources> withNormals(
  const std::string& lasPath, const AttributePass& pass, const PassResources& resources)
{
  Result<LASFile> file = LASFile::open(lasPath);
  if (!file)
  {
    return file.error();
  }
  Result<std::unique_ptr<PointSource>> source = LASSource::open(std::move(*file));
  if (!source)
  {
    return source.error();
  }
  PointSources sources;
  sources.push_back(std::move(*source));
  return pass.apply(std::move(sources), resources);
}
} // namespace

ProgressFunction partOf(const ProgressFunction& progress, double first, double share)
{
  if (!progress)
  {
    return {};
  }
  return [progress, first, share](Progress state)
  {
    state.fraction = first + share * state.fraction;
    return progress(state);
  };
}

Result<std::unique_ptr<IndexedNormals>> IndexedNormals::compute(
  const std::string& lasPath, const AttributePass& pass, const PassResources& resources)
{
  PassResources ofPass = resources;
  ofPass.progress = partOf(resources.progress, 0.0, passShare);
  const Result<PointSources> sources = withNormals(lasPath, pass, ofPass);
  if (!sources)
  {
    return sources.error();
  }
  const InputOrder order(*sources);
  const PointSource& source = *sources->front();
  const std::size_t column = *source.description().schema.find(normalAttribute().name);
  std::unique_ptr<IndexedNormals> normals(new IndexedNormals);
  normals->spilledBytes_ = order.points() * normalBytes;
  normals->range_ = emptyRange(normalAttribute());
  Result<std::unique_ptr<SpillFile>> file = SpillFile::create(
    resources.temporaryFolder, normals->spilledBytes_, SpillFile::Way::ThroughCache);
  if (!file)
  {
    return file.error();
  }
  normals->file_ = std::move(*file);
  WorkCrew crew(resources.threads, partOf(resources.progress, passShare, 1.0 - passShare));
  crew.beginPhase("normals", order.points(), 1.0);
  std::atomic<std::uint64_t> next{ 0 };
  std::mutex mutex; // guards the range
  Result<void> done = crew.run(
    [&]() -> Result<void>
    {
      PointBatch batch;
      for (std::uint64_t chunk = next++; chunk < order.chunks() && !crew.stopped(); chunk = next++)
      {
        Result<void> step = source.read(chunk, batch);
        const std::uint64_t first = order.first({ 0, chunk });
        step = step ? normals->file_->write(first * normalBytes, batch.columns[column].data(),
                        batch.columns[column].size())
                    : step;
        if (!step)
        {
          return step;
        }
        const ColumnRange range =
          rangeOf(batch.columns[column].data(), normalAttribute(), batch.size());
        crew.advance(batch.size());
        const std::lock_guard<std::mutex> lock(mutex);
        addRange(normals->range_, range);
      }
      return {};
    });
  if (!done)
  {
    return done.error();
  }
  normals->findings_ = pass.findings();
  return normals;
}

Result<void> IndexedNormals::append(
  const std::vector<std::uint64_t>& points, SideFileWriter& writer, InPlaceTable& table) const
{
  const ValuesInFile place{ 0, normalBytes,
    [this](std::uint64_t offset, std::byte* data, std::size_t bytes)
    { return file_->read(offset, data, bytes); } };
  const Result<RawBytes> values = gatherValues(place, points);
  if (!values)
  {
    return values.error();
  }
  const CodedBlock coded =
    encodeBlock(values->data.get(), { points.size(), 3, sizeof(PackedNormal::value_type) });
  const Result<std::uint64_t> offset = writer.append(coded.bytes);
  if (!offset)
  {
    return offset.error();
  }
  table.blocks.push_back({ *offset, static_cast<std::uint32_t>(coded.bytes.size()),
    checksumOf(coded.bytes.data(), coded.bytes.size()), coded.codec });
  return {};
}

void IndexedNormals::describe(StoreDescription& description, const std::string& origin) const
{
  Attribute attribute = normalAttribute();
  attribute.description = "unit normal; zero where there is none; " + origin;
  description.schema.add(std::move(attribute));
  description.ranges.push_back(range_);
}

} // namespace pointfront
