#include "CollectionTest.h"
#include "CountedBytes.h"
#include "ForgedStore.h"

#include "pointfront/Disk/OutputFile.h"

namespace pointfront
{
namespace
{
using namespace pointfront::test;
namespace fs = std::filesystem;

class CollectionFaults : public CollectionTest
{
};

TEST_F(CollectionFaults, RefuseWhatIsNoTile)
{
  const std::vector<TileRequest> tiles = row(2);
  created(tiles);
  const auto refusal = [&](const Result<CollectionReport>& report)
  {
    EXPECT_FALSE(report);
    return report ? std::string() : report.error().what;
  };
  EXPECT_NE(refusal(addTiles(city(), { tiles[1] }, {})).find("already"), std::string::npos);
  EXPECT_NE(
    refusal(addTiles(city(), { { city() } }, {})).find("made of tiles itself"), std::string::npos);
  EXPECT_NE(
    refusal(addTiles(city(), { { at("no.pfront") } }, {})).find("no.pfront"), std::string::npos);
  EXPECT_NE(refusal(removeTiles(city(), { "t7" }, {})).find("'t7'"), std::string::npos);
  EXPECT_NE(
    refusal(removeTiles(city(), { "t0", "t1" }, {})).find("no tile left"), std::string::npos);
  EXPECT_NE(refusal(replaceTiles(city(), { { at("t7.pfront") } }, {})).find("has no tile 't7'"),
    std::string::npos);
  EXPECT_FALSE(addTiles(tiles[0].path, { tiles[1] }, {})); // a store is no collection
  EXPECT_EQ(points(*opened()), expected({ 0, 1000 }));
  for (const auto& entry : fs::directory_iterator(folder_))
  {
    EXPECT_NE(entry.path().extension(), ".tmp") << entry.path();
  }
}

TEST_F(CollectionFaults, TheSecondWriterIsTold)
{
  const std::vector<TileRequest> tiles = row(3);
  created({ tiles[0] });
  const auto first = OutputFile::create(city());
  ASSERT_TRUE(first);
  const auto second = addTiles(city(), { tiles[1] }, {});
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().what.find("another process is writing"), std::string::npos);
  EXPECT_EQ(opened()->record().state, 1u);
}

TEST_F(CollectionFaults, AreNoStores)
{
  created(row(2));
  const auto store = PointStore::open(city());
  ASSERT_FALSE(store);
  EXPECT_NE(store.error().what.find("is a collection"), std::string::npos);
  EXPECT_TRUE(PointStore::looksLikeCollection(city()));
  EXPECT_FALSE(PointStore::looksLikeCollection(at("t0.pfront")));
  EXPECT_FALSE(CollectionCloud::open(at("t0.pfront")));
}

/// Bytes of the record that are cut, flipped or of a newer version.
TEST_F(CollectionFaults, ARecordThatLiesIsRefused)
{
  created(row(3));
  const CollectionRecord record = opened()->record();
  const std::vector<std::byte> bytes = record.encode();
  ASSERT_TRUE(CollectionRecord::decode(bytes.data(), bytes.size()));
  EXPECT_EQ(CollectionRecord::decode(bytes.data(), bytes.size())->encode(), bytes);
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 7)
  {
    const auto cut = CollectionRecord::decode(bytes.data(), size);
    EXPECT_FALSE(cut && cut->version <= CollectionRecord::newest) << size;
  }
  std::vector<std::byte> newer = bytes;
  newer[0] = std::byte(9);
  ASSERT_TRUE(CollectionRecord::decode(newer.data(), newer.size()));
  EXPECT_EQ(CollectionRecord::decode(newer.data(), newer.size())->version, 9u);
  Random random(5);
  for (int i = 0; i < 2000; ++i)
  {
    std::vector<std::byte> flipped = bytes;
    const auto place = static_cast<std::size_t>(random.uniform() * double(bytes.size()));
    flipped[place] ^= std::byte(1u << (i % 8));
    const auto read = CollectionRecord::decode(flipped.data(), flipped.size()); // does not crash
    EXPECT_TRUE(!read || read->version != 1 || !read->tiles.empty());
  }
}

/// Whoever serves or passes on a collection does not choose what others read, and how.
TEST_F(CollectionFaults, ATileThatItMayNotNameIsRefused)
{
  const auto counts = CountedBytes::add();
  const auto kept = tile("t0.pfront", 1000, 16.0);
  const auto refusal = [](const std::string& path)
  {
    const auto cloud = CollectionCloud::open(path);
    EXPECT_TRUE(cloud || cloud.error().kind == Error::Kind::Unsupported) << cloud.error().what;
    return cloud ? std::string() : cloud.error().what;
  };
  for (const std::string name :
    { "counted://host/b.pfront#far:cache=/tmp", "b.pfront#far:offline=1", "/away/b.pfront" })
  {
    const std::string plain = std::string(name.size() - 7, 'x') + ".pfront";
    const TileRequest other = tile(plain, 0, 0.0);
    for (const bool removed : { false, true })
    {
      created({ kept, other });
      if (removed)
      {
        sound(removeTiles(city(), { other.path }, {}));
      }
      ForgedStore forged(city());
      std::vector<std::byte> bytes = forged.section(SectionKind::Description);
      const auto at = std::search(bytes.begin(), bytes.end(), plain.begin(), plain.end(),
        [](std::byte byte, char letter) { return byte == std::byte(letter); });
      ASSERT_NE(at, bytes.end());
      std::transform(name.begin(), name.end(), at, [](char letter) { return std::byte(letter); });
      forged.replaceSection(SectionKind::Description, bytes);
      forged.write(city());
      const bool sets = name.find("#far:") != std::string::npos;
      const std::string far = refusal(CountedBytes::addressOf(city()));
      EXPECT_NE(far.find(sets ? "settings" : "names the file '/away"), std::string::npos) << far;
      // On a disk it is the path of a file.
      EXPECT_EQ(refusal(city()).find("settings") != std::string::npos, isAddress(name)) << name;
    }
  }
}

TEST_F(CollectionFaults, DamagedFilesAreRefused)
{
  created(row(3));
  std::string bytes;
  {
    std::ifstream file(city(), std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  const auto refused = [&](const std::string& damaged)
  {
    std::ofstream(city(), std::ios::binary | std::ios::trunc) << damaged;
    const auto cloud = CollectionCloud::open(city());
    return !cloud || !(*cloud)->verify()->ok;
  };
  EXPECT_TRUE(refused(bytes.substr(0, bytes.size() / 2)));
  EXPECT_TRUE(refused(bytes + "x"));
  Random random(3);
  for (int i = 0; i < 60; ++i)
  {
    std::string damaged = bytes;
    damaged[static_cast<std::size_t>(random.uniform() * double(bytes.size()))] ^= 0x40;
    EXPECT_TRUE(refused(damaged)) << i;
  }
  EXPECT_FALSE(refused(bytes));
}

} // namespace
} // namespace pointfront
