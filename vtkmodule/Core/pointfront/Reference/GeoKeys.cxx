#include "pointfront/Reference/GeoKeys.h"

#include "pointfront/Points/PointSource.h"

#include <algorithm>
#include <cstring>

namespace pointfront
{
namespace
{
constexpr std::size_t wordsOfEntry = 4; // key, where its value is, count, value or its place

const MetadataRecord* projectionRecord(const std::vector<MetadataRecord>& records, std::uint16_t id)
{
  const auto found = std::find_if(records.begin(), records.end(),
    [&](const MetadataRecord& r) { return r.owner == "LASF_Projection" && r.id == id; });
  return found == records.end() ? nullptr : &*found;
}
} // namespace

GeoKeys GeoKeys::parse(const std::vector<std::uint16_t>& directory, const std::string& text)
{
  GeoKeys keys;
  if (directory.size() < wordsOfEntry)
  {
    return keys;
  }
  const std::size_t present = directory.size() / wordsOfEntry - 1;
  const std::size_t entries = std::min<std::size_t>(directory[3], present);
  for (std::size_t i = 1; i <= entries; ++i)
  {
    const std::uint16_t* entry = directory.data() + i * wordsOfEntry;
    const std::size_t count = entry[2];
    const std::size_t place = entry[3];
    if (entry[1] == 0)
    {
      keys.codes_[entry[0]] = entry[3];
    }
    else if (entry[1] == textTag && place <= text.size() && count <= text.size() - place)
    {
      std::string value = text.substr(place, count);
      value.erase(std::min(value.find_first_of(std::string("|\0", 2)), value.size()));
      keys.texts_[entry[0]] = std::move(value);
    }
  }
  return keys;
}

GeoKeys GeoKeys::parse(const std::vector<MetadataRecord>& records)
{
  const MetadataRecord* directory = projectionRecord(records, directoryTag);
  if (directory == nullptr)
  {
    return {};
  }
  std::vector<std::uint16_t> words(directory->payload.size() / sizeof(std::uint16_t));
  for (std::size_t i = 0; i < words.size(); ++i) // little endian, as all of LAS
  {
    const auto low = std::to_integer<unsigned>(directory->payload[2 * i]);
    const auto high = std::to_integer<unsigned>(directory->payload[2 * i + 1]);
    words[i] = static_cast<std::uint16_t>(low | high << 8);
  }
  std::string text;
  if (const MetadataRecord* record = projectionRecord(records, textTag))
  {
    text.assign(reinterpret_cast<const char*>(record->payload.data()), record->payload.size());
  }
  return parse(words, text);
}

std::optional<std::uint16_t> GeoKeys::code(Key key) const
{
  const auto found = codes_.find(key);
  return found == codes_.end() ? std::nullopt : std::optional<std::uint16_t>(found->second);
}

std::string GeoKeys::text(Key key) const
{
  const auto found = texts_.find(key);
  return found == texts_.end() ? std::string() : found->second;
}

} // namespace pointfront
