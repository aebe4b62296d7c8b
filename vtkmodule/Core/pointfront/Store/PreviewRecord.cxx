#include "pointfront/Store/PreviewRecord.h"

#include <filesystem>
#include <system_error>

namespace pointfront
{
namespace
{
const std::string owner = "pointfront";
constexpr std::uint16_t recordId = 1;
constexpr std::size_t numbersBytes = 24; ///< three little-endian 64-bit numbers before the name
const std::string extension = ".pfront";
const std::string previewExtension = ".preview.pfront";

void put(std::vector<std::byte>& bytes, std::uint64_t value)
{
  for (unsigned i = 0; i < 8; ++i)
  {
    bytes.push_back(static_cast<std::byte>(value >> (8 * i)));
  }
}

std::uint64_t get(const std::vector<std::byte>& bytes, std::size_t offset)
{
  std::uint64_t value = 0;
  for (unsigned i = 0; i < 8; ++i)
  {
    value |= std::to_integer<std::uint64_t>(bytes[offset + i]) << (8 * i);
  }
  return value;
}

bool endsWith(const std::string& text, const std::string& end)
{
  return text.size() > end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}
} // namespace

MetadataRecord previewMetadata(const PreviewRecord& record)
{
  MetadataRecord metadata;
  metadata.owner = owner;
  metadata.id = recordId;
  metadata.description = "preview of a build";
  put(metadata.payload, record.pointsExpected);
  put(metadata.payload, record.pointsRead);
  put(metadata.payload, record.pointsFinished);
  for (const char c : record.storeName)
  {
    metadata.payload.push_back(static_cast<std::byte>(c));
  }
  return metadata;
}

std::optional<PreviewRecord> previewRecordOf(const std::vector<MetadataRecord>& metadata)
{
  for (const MetadataRecord& candidate : metadata)
  {
    if (candidate.owner != owner || candidate.id != recordId ||
      candidate.payload.size() < numbersBytes)
    {
      continue;
    }
    PreviewRecord record;
    record.pointsExpected = get(candidate.payload, 0);
    record.pointsRead = get(candidate.payload, 8);
    record.pointsFinished = get(candidate.payload, 16);
    for (std::size_t i = numbersBytes; i < candidate.payload.size(); ++i)
    {
      record.storeName.push_back(std::to_integer<char>(candidate.payload[i]));
    }
    return record;
  }
  return std::nullopt;
}

std::string previewPathOf(const std::string& storePath)
{
  const std::string stem = endsWith(storePath, extension)
    ? storePath.substr(0, storePath.size() - extension.size())
    : storePath;
  return stem + previewExtension;
}

std::optional<std::string> storePathOfPreview(const std::string& previewPath)
{
  if (!endsWith(previewPath, previewExtension))
  {
    return std::nullopt;
  }
  return previewPath.substr(0, previewPath.size() - previewExtension.size()) + extension;
}

std::string presentStorePath(const std::string& path)
{
  std::error_code ignored;
  const auto finished = storePathOfPreview(path);
  return finished && !std::filesystem::exists(path, ignored) &&
      std::filesystem::exists(*finished, ignored)
    ? *finished
    : path;
}

} // namespace pointfront
