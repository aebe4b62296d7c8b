#include "LASRecords.h"

#include "pointfront/Base/PrintableText.h"

namespace pointfront
{
namespace
{
/// Where one family of records lies and how its headers look.
struct RecordRun
{
  const char* name;
  std::uint64_t begin;
  std::uint64_t end; ///< records may not reach beyond this byte
  const char* endName;
  std::uint32_t count;
  std::size_t headerBytes;
};

std::string lostRecords(const RecordRun& run, std::uint32_t index, std::uint64_t byte)
{
  return std::string(run.name) + " " + std::to_string(index + 1) + " of " +
    std::to_string(run.count) + " at byte " + std::to_string(byte) + " does not end before " +
    run.endName + " at byte " + std::to_string(run.end) + ": " + std::to_string(run.count - index) +
    " of these records were lost.";
}

void readRun(ByteSpan file, const RecordRun& run, std::vector<LASRecord>& records,
  std::vector<std::string>& warnings)
{
  std::uint64_t at = run.begin;
  for (std::uint32_t index = 0; index < run.count; ++index)
  {
    if (at > run.end || run.end - at < run.headerBytes)
    {
      warnings.push_back(lostRecords(run, index, at));
      return;
    }
    const std::byte* head = file.data + at;
    const bool extended = run.headerBytes == lasExtendedRecordHeaderBytes;
    const std::uint64_t length =
      extended ? loadNumber<std::uint64_t>(head + 20) : loadNumber<std::uint16_t>(head + 20);
    if (length > run.end - at - run.headerBytes)
    {
      warnings.push_back(lostRecords(run, index, at));
      return;
    }
    LASRecord record;
    record.owner = printableText(loadText(head + 2, 16));
    record.id = loadNumber<std::uint16_t>(head + 18);
    record.description = printableText(loadText(head + run.headerBytes - 32, 32));
    record.payload = { head + run.headerBytes, static_cast<std::size_t>(length) };
    records.push_back(std::move(record));
    at += run.headerBytes + length;
  }
}
} // namespace

std::vector<LASRecord> readLASRecords(
  ByteSpan file, const LASHeader& header, std::vector<std::string>& warnings)
{
  std::vector<LASRecord> records;
  readRun(file,
    { "Variable length record", header.headerBytes, header.pointOffset, "the points",
      header.recordCount, lasRecordHeaderBytes },
    records, warnings);
  if (header.extendedRecordCount > 0)
  {
    readRun(file,
      { "Extended variable length record", header.extendedRecordOffset, file.size,
        "the end of the file", header.extendedRecordCount, lasExtendedRecordHeaderBytes },
      records, warnings);
  }
  return records;
}

} // namespace pointfront
