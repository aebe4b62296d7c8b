#include "pointfront/Build/SampleRecords.h"

#include "pointfront/Ingest/RecordPacker.h"

namespace pointfront
{
namespace
{
constexpr unsigned oneCell = 31; // the packer's counts are of no interest here
} // namespace

std::vector<std::byte> sampleRecords(const PointSources& sample, const RecordForm& form,
  const std::optional<ColourWidening>& widening, const std::vector<bool>& widened)
{
  std::vector<std::byte> records;
  RecordPacker packer(form.common, form.columns, form.space, oneCell, std::nullopt);
  const std::size_t recordBytes = RecordLayout(form.columns.schema()).bytes();
  PointBatch batch;
  for (std::size_t s = 0; s < sample.size(); ++s)
  {
    for (std::uint64_t chunk = 0; chunk < sample[s]->chunkCount(); ++chunk)
    {
      if (!sample[s]->read(chunk, batch))
      {
        continue;
      }
      packer.begin(batch.size());
      if (!packer.append(sample[s]->description().schema, s, batch))
      {
        continue;
      }
      packer.order();
      const std::size_t begin = records.size();
      records.resize(begin + packer.count() * recordBytes);
      packer.writeTo(records.data() + begin);
      for (std::size_t at = begin; at < records.size(); at += recordBytes)
      {
        std::byte* record = records.data() + at;
        setPosition(record, form.space.relativeSteps(positionOf(record)));
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
