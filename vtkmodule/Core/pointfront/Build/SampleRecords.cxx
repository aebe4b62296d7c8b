#include "pointfront/Build/SampleRecords.h"

#include "pointfront/Build/RecordPacker.h"

namespace pointfront
{
namespace
{
constexpr unsigned oneCell = 31; // the packer's counts are of no interest here
} // namespace

std::vector<std::byte> sampleRecords(const PointSources& sample, const CommonSchema& schema,
  const TreeSpace& space, const std::optional<ColourWidening>& widening,
  const std::vector<bool>& widened)
{
  std::vector<std::byte> records;
  RecordPacker packer(schema, space, oneCell, std::nullopt);
  const std::size_t recordBytes = RecordLayout(schema.schema).bytes();
  PointBatch batch;
  for (std::size_t s = 0; s < sample.size(); ++s)
  {
    for (std::uint64_t chunk = 0; chunk < sample[s]->chunkCount(); ++chunk)
    {
      if (!sample[s]->read(chunk, batch))
      {
        continue;
      }
      packer.pack(sample[s]->description().schema, s, batch);
      const std::size_t begin = records.size();
      records.insert(records.end(), packer.records().begin(),
        packer.records().begin() + static_cast<std::ptrdiff_t>(packer.count() * recordBytes));
      for (std::size_t at = begin; at < records.size(); at += recordBytes)
      {
        std::byte* record = records.data() + at;
        setPosition(record, space.relativeSteps(positionOf(record)));
        if (widened[s])
        {
          widening->widen(record);
        }
      }
    }
  }
  return records;
}

} // namespace pointfront
