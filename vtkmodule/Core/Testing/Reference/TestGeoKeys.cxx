#include "pointfront/Points/PointSource.h"
#include "pointfront/Reference/GeoKeys.h"

#include <gtest/gtest.h>

#include <cstring>

using namespace pointfront;

namespace
{
const std::string text = std::string("NAD83(HARN) / Oregon|NAD83|\0", 28);

std::vector<std::uint16_t> oregon()
{
  return { 1, 1, 0, 4, //
    1024, 0, 1, 1, // a projected system
    1026, 34737, 21, 0, // its name
    2049, 34737, 6, 21, //
    3072, 0, 1, 2994 };
}

MetadataRecord record(std::uint16_t id, const void* data, std::size_t bytes)
{
  const auto* first = static_cast<const std::byte*>(data);
  return { "LASF_Projection", id, "", { first, first + bytes } };
}
} // namespace

TEST(GeoKeys, CodesAndTextsAreFoundByTheirKey)
{
  const GeoKeys keys = GeoKeys::parse(oregon(), text);
  EXPECT_EQ(keys.code(GeoKeys::ProjectedSystem), std::uint16_t(2994));
  EXPECT_EQ(keys.code(GeoKeys::ModelType), std::uint16_t(1));
  EXPECT_FALSE(keys.code(GeoKeys::VerticalSystem));
  EXPECT_EQ(keys.text(GeoKeys::Citation), "NAD83(HARN) / Oregon");
  EXPECT_EQ(keys.text(GeoKeys::ProjectedCitation), "");
  EXPECT_FALSE(keys.pixelIsPoint());
  EXPECT_FALSE(keys.empty());
}

TEST(GeoKeys, RasterTypeTwoIsPixelIsPoint)
{
  EXPECT_TRUE(GeoKeys::parse({ 1, 1, 0, 1, 1025, 0, 1, 2 }, "").pixelIsPoint());
  EXPECT_FALSE(GeoKeys::parse({ 1, 1, 0, 1, 1025, 0, 1, 1 }, "").pixelIsPoint());
}

TEST(GeoKeys, ADirectoryThatLiesGivesFewerKeysAndNeverReadsOutside)
{
  std::vector<std::uint16_t> words = oregon();
  words[3] = 65535; // claims more entries than there are
  EXPECT_EQ(GeoKeys::parse(words, text).code(GeoKeys::ProjectedSystem), std::uint16_t(2994));
  words.resize(18); // the last entry is cut
  EXPECT_FALSE(GeoKeys::parse(words, text).code(GeoKeys::ProjectedSystem));
  words[11] = 65000; // the text lies outside
  EXPECT_EQ(GeoKeys::parse(words, text).text(GeoKeys::Citation), "");
  EXPECT_TRUE(GeoKeys::parse({}, text).empty());
  EXPECT_TRUE(GeoKeys::parse({ 1, 1, 0 }, text).empty());
}

TEST(GeoKeys, RecordsOfALasFileAreTheSameTags)
{
  const std::vector<std::uint16_t> words = oregon();
  const std::vector<MetadataRecord> records{ record(34737, text.data(), text.size()),
    record(34735, words.data(), 2 * words.size()) };
  EXPECT_EQ(GeoKeys::parse(records).code(GeoKeys::ProjectedSystem), std::uint16_t(2994));
  EXPECT_EQ(GeoKeys::parse(records).text(GeoKeys::Citation), "NAD83(HARN) / Oregon");
  EXPECT_TRUE(GeoKeys::parse(std::vector<MetadataRecord>{}).empty());
}
