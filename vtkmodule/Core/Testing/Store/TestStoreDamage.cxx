#include "ForgedStore.h"
#include "GoldenFiles.h"
#include "SampleStore.h"

#include "pointfront/Codec/Checksum.h"
#include "pointfront/Store/NodePage.h"
#include "pointfront/Store/NodeTableSection.h"
#include "pointfront/Store/PayloadDirectory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>

namespace pointfront
{
namespace
{
std::string soundStore(std::uint32_t pointsPerNode = 20)
{
  const std::string path = temporaryPath("sound.pfront");
  writeSample(makeSample(pointsPerNode), path);
  return path;
}

Error openFails(const std::string& path)
{
  const auto opened = PointStore::open(path);
  EXPECT_FALSE(opened) << path;
  return opened ? Error{} : opened.error();
}

bool mentions(const Error& error, const std::string& text)
{
  return error.what.find(text) != std::string::npos;
}

/// Where the record of a node begins in the block directory.
std::size_t recordOf(const ForgedStore& forged, NodeIndex node)
{
  return node * payloadRecordBytes(forged.footer.columnCount + 1);
}

/// Gives a record the checksum of what stands in it now.
void sign(std::vector<std::byte>& directory, const ForgedStore& forged, NodeIndex node)
{
  const std::size_t begin = recordOf(forged, node);
  const std::size_t end = recordOf(forged, node + 1) - 4;
  const std::uint32_t checksum = checksumOf(directory.data() + begin, end - begin);
  std::memcpy(directory.data() + end, &checksum, sizeof(checksum));
}

template <typename T>
void poke(std::vector<std::byte>& bytes, std::size_t at, T value)
{
  std::memcpy(bytes.data() + at, &value, sizeof(T));
}
} // namespace

TEST(StoreDamage, CutAtAnyByteIsTruncated)
{
  const std::string path = soundStore(3);
  for (std::uint64_t length = std::filesystem::file_size(path); length-- > 0;)
  {
    std::filesystem::resize_file(path, length);
    const Error error = openFails(path);
    ASSERT_EQ(error.kind, Error::Kind::Truncated) << length << ": " << error.what;
    ASSERT_TRUE(mentions(error, path) && mentions(error, "again")) << error.what;
  }
}

TEST(StoreDamage, EveryFlippedBitIsFound)
{
  const std::string path = soundStore(3);
  const std::vector<std::byte> sound = fileBytes(path);
  std::fstream file(path, std::ios::binary | std::ios::in | std::ios::out);
  const auto put = [&](std::size_t at, std::byte value)
  {
    file.seekp(static_cast<std::streamoff>(at));
    file.put(static_cast<char>(value));
    file.flush();
  };
  for (std::size_t at = 0; at < sound.size(); ++at)
  {
    put(at, sound[at] ^ static_cast<std::byte>(1 << (at * 7 % 8)));
    const auto opened = PointStore::open(path);
    if (opened)
    {
      const auto report = (*opened)->verify();
      ASSERT_TRUE(report);
      ASSERT_FALSE(report->ok) << "byte " << at << " of " << sound.size();
      ASSERT_NE(report->firstError.find("node "), std::string::npos) << report->firstError;
      ASSERT_NE(report->firstError.find("(byte "), std::string::npos) << report->firstError;
    }
    else if (at >= storeMagic.size())
    {
      ASSERT_EQ(opened.error().kind, Error::Kind::Corrupt) << at << ": " << opened.error().what;
    }
    put(at, sound[at]);
  }
  EXPECT_TRUE(file.good());
}

TEST(StoreDamage, AddedBytesAreFound)
{
  std::vector<std::byte> bytes = fileBytes(soundStore());
  bytes.push_back(std::byte(0));
  const std::string path = temporaryPath("long.pfront");
  writeFile(path, bytes);
  EXPECT_EQ(openFails(path).kind, Error::Kind::Corrupt);
}

TEST(StoreDamage, DamagedNodeIsNamedAndOthersStayReadable)
{
  const std::string sound = soundStore(1000);
  const SampleStore sample = makeSample(1000);
  std::vector<std::byte> bytes = fileBytes(sound);
  // First pieces follow in the order of the nodes: a byte of the positions of node 3.
  const ColumnPieces pieces = chooseColumnPieces(sample.description.schema);
  std::size_t at = storeHeaderBytes + 5;
  for (NodeIndex i = 0; i < 3; ++i)
  {
    const EncodedNode node = encodeNode(sample.points[i], sample.description.schema);
    at += node.positions.bytes.size();
    for (std::size_t c = 0; c < pieces.size(); ++c)
    {
      at += pieces[c] == 0 ? node.columns[c].bytes.size() : 0;
    }
  }
  bytes[at] ^= std::byte(16);
  const std::string path = temporaryPath("damaged.pfront");
  writeFile(path, bytes);
  const auto damaged = PointStore::open(path);
  ASSERT_TRUE(damaged) << damaged.error().what;
  EXPECT_TRUE((*damaged)->read(2, { 0 }));
  const auto points = (*damaged)->read(3, { 0 });
  ASSERT_FALSE(points);
  EXPECT_EQ(points.error().kind, Error::Kind::Corrupt);
  EXPECT_TRUE(mentions(points.error(), "node 3, positions")) << points.error().what;
  EXPECT_TRUE(mentions(points.error(), "(byte " + std::to_string(at - 5) + ")"))
    << points.error().what;
  const auto report = (*damaged)->verify();
  ASSERT_TRUE(report);
  EXPECT_EQ(report->firstError, points.error().what);
  EXPECT_EQ(report->nodesChecked, 3u);
}

TEST(StoreDamage, OtherFilesAreNotStores)
{
  const std::string text = temporaryPath("text.pfront");
  const char words[] = "this is a text that is longer than a header, it goes on and on and on";
  writeFile(text,
    { reinterpret_cast<const std::byte*>(words),
      reinterpret_cast<const std::byte*>(words) + sizeof(words) });
  EXPECT_EQ(openFails(text).kind, Error::Kind::BadFormat);
  EXPECT_FALSE(PointStore::looksLikeStore(text));
  EXPECT_EQ(openFails(temporaryPath("absent.pfront")).kind, Error::Kind::NotFound);
  EXPECT_FALSE(PointStore::looksLikeStore(temporaryPath("absent.pfront")));
  EXPECT_EQ(openFails(testing::TempDir()).kind, Error::Kind::Unreadable);
  EXPECT_EQ(openFails("/dev/zero").kind, Error::Kind::Unreadable);
  EXPECT_TRUE(PointStore::looksLikeStore(soundStore()));
}

TEST(StoreDamage, NewerVersionsAreNamed)
{
  ForgedStore forged(soundStore());
  const std::string path = temporaryPath("newer.pfront");
  forged.header.version = 5;
  forged.write(path);
  const Error newer = openFails(path);
  EXPECT_EQ(newer.kind, Error::Kind::Unsupported);
  EXPECT_TRUE(
    mentions(newer, "version 5") && mentions(newer, "up to version 4") && mentions(newer, "update"))
    << newer.what;
  EXPECT_TRUE(PointStore::looksLikeStore(path));
  forged.header.version = 2;
  forged.header.requiredFeatures = 4;
  forged.write(path);
  EXPECT_EQ(openFails(path).kind, Error::Kind::Unsupported);
}

TEST(StoreDamage, UnknownCodecIsUnsupported)
{
  ForgedStore forged(soundStore());
  std::vector<std::byte> directory = forged.section(SectionKind::BlockDirectory);
  directory[recordOf(forged, 6) - 5] = std::byte(77); // the last codec of node 5
  sign(directory, forged, 5);
  forged.replaceSection(SectionKind::BlockDirectory, directory);
  const std::string path = temporaryPath("codec.pfront");
  forged.write(path);
  const auto store = PointStore::open(path);
  ASSERT_TRUE(store) << store.error().what;
  EXPECT_TRUE((*store)->read(4, {}));
  const auto points = (*store)->read(5, {});
  ASSERT_FALSE(points);
  EXPECT_EQ(points.error().kind, Error::Kind::Unsupported);
  EXPECT_TRUE(mentions(points.error(), "codec 77")) << points.error().what;
}

TEST(StoreDamage, ColumnsWithoutASoundScaleAreRefused)
{
  const std::string name = "intensity";
  for (const std::size_t field : { 0, 1 }) // scale, offset
  {
    for (const double value : { std::nan(""), std::numeric_limits<double>::infinity() })
    {
      ForgedStore forged(soundStore());
      std::vector<std::byte> section = forged.section(SectionKind::Description);
      const auto* const key = reinterpret_cast<const std::byte*>(name.data());
      const auto found = std::search(section.begin(), section.end(), key, key + name.size());
      ASSERT_NE(found, section.end());
      auto at = static_cast<std::size_t>(found - section.begin()) + name.size();
      std::uint32_t description = 0;
      std::memcpy(&description, section.data() + at, sizeof(description));
      at += sizeof(description) + description + 2; // type, components
      poke(section, at + field * sizeof(double), value);
      forged.replaceSection(SectionKind::Description, section);
      const std::string path = temporaryPath("scale.pfront");
      forged.write(path);
      EXPECT_EQ(openFails(path).kind, Error::Kind::Corrupt);
    }
  }
}

TEST(StoreDamage, UnknownCodecOfVersion1IsUnsupported)
{
  ForgedStore forged(goldenFile("version1.pfront"));
  std::vector<std::byte> directory = forged.section(SectionKind::BlockDirectory);
  directory.back() = std::byte(77); // the codecs are its last array
  forged.replaceSection(SectionKind::BlockDirectory, directory);
  const std::string path = temporaryPath("codec.pfront");
  forged.write(path);
  const Error error = openFails(path);
  EXPECT_EQ(error.kind, Error::Kind::Unsupported);
  EXPECT_TRUE(mentions(error, "codec 77")) << error.what;
}

// Sizes that would ask for far more memory than the file is long, all checksums right.
TEST(StoreDamage, HugeClaimsAreRefused)
{
  const std::string sound = soundStore();
  const std::string path = temporaryPath("huge.pfront");
  const auto refused = [&](const char* what, const auto& change)
  {
    ForgedStore forged(sound);
    change(forged);
    forged.write(path);
    EXPECT_EQ(openFails(path).kind, Error::Kind::Corrupt) << what;
  };
  refused("nodes", [](ForgedStore& f) { f.footer.nodeCount = 0xffffffffu; });
  refused("columns", [](ForgedStore& f) { f.footer.columnCount = 0xffffffffu; });
  refused("points", [](ForgedStore& f) { f.footer.pointCount = UINT64_MAX; });
  refused("section size", [](ForgedStore& f) { f.footer.sections[0].bytes = UINT64_MAX - 100; });
  refused("section offset", [](ForgedStore& f) { f.footer.sections[1].offset = UINT64_MAX; });
  refused("section in header", [](ForgedStore& f) { f.footer.sections[2].offset = 3; });
  refused("missing section",
    [](ForgedStore& f) { f.footer.sections[2].kind = static_cast<SectionKind>(99); });
  refused("footer", [](ForgedStore& f) { f.header.footerOffset = UINT64_MAX - 3; });
  refused("points of a node",
    [](ForgedStore& f)
    {
      NodePage page;
      const TableLimits limits{ f.footer.nodeCount, 2 };
      const std::vector<std::byte> table = f.section(SectionKind::NodeTable);
      EXPECT_EQ(decodeNodePage(table.data(), 0, limits, page), "");
      page[4].pointCount = 0xffffffffu;
      std::vector<std::byte> forged(nodePageBytes);
      encodeNodePage(page.data(), f.footer.nodeCount, 0, forged.data());
      f.replaceSection(SectionKind::NodeTable, forged);
    });
}

// Parts that open() does not read: a fault is found when the node is read.
TEST(StoreDamage, HugeClaimsOfANodeAreRefusedWhenItIsRead)
{
  const std::string sound = soundStore();
  const std::string path = temporaryPath("huge.pfront");
  const auto refused = [&](const char* what, std::size_t at, auto value)
  {
    ForgedStore forged(sound);
    std::vector<std::byte> directory = forged.section(SectionKind::BlockDirectory);
    poke(directory, recordOf(forged, 3) + at, value);
    sign(directory, forged, 3);
    forged.replaceSection(SectionKind::BlockDirectory, directory);
    forged.write(path);
    const auto store = PointStore::open(path);
    ASSERT_TRUE(store) << store.error().what;
    EXPECT_TRUE((*store)->read(2, {}));
    const auto points = (*store)->read(3, {});
    ASSERT_FALSE(points) << what;
    EXPECT_EQ(points.error().kind, Error::Kind::Corrupt) << what;
    EXPECT_TRUE(mentions(points.error(), "node 3")) << points.error().what;
    EXPECT_FALSE((*store)->verify()->ok);
  };
  refused("origin", 0, INT64_MAX);
  refused("first piece behind the file", 24, UINT64_MAX - 5);
  refused("first piece in the header", 24, std::uint64_t(3));
  refused("second piece behind the file", 32, UINT64_MAX - 5);
  refused("second piece in another file, which is not there", 32, (std::uint64_t(1) << 63) + 64);
  refused("second piece in the header", 32, std::uint64_t(3));
  refused("block size", 40, 0xffffffffu);
}

TEST(StoreDamage, PiecesThatOverlapAreRefused)
{
  ForgedStore forged(soundStore());
  std::vector<std::byte> directory = forged.section(SectionKind::BlockDirectory);
  std::uint64_t first = 0;
  std::memcpy(&first, directory.data() + recordOf(forged, 3) + 24, sizeof first);
  poke(directory, recordOf(forged, 3) + 32, first + 1);
  sign(directory, forged, 3);
  forged.replaceSection(SectionKind::BlockDirectory, directory);
  const std::string path = temporaryPath("overlap.pfront");
  forged.write(path);
  const auto store = PointStore::open(path);
  ASSERT_TRUE(store) << store.error().what;
  const auto points = (*store)->read(3, {});
  ASSERT_FALSE(points);
  EXPECT_EQ(points.error().kind, Error::Kind::Corrupt);
  EXPECT_TRUE(mentions(points.error(), "node 3: the pieces of its payload overlap"))
    << points.error().what;
}

TEST(StoreDamage, PiecesThatDoNotExistAreRefused)
{
  ForgedStore forged(soundStore());
  forged.footer.pieces[4] = 2;
  const std::string path = temporaryPath("piece.pfront");
  forged.write(path);
  const Error error = openFails(path);
  EXPECT_EQ(error.kind, Error::Kind::Corrupt);
  EXPECT_TRUE(mentions(error, "the footer names a piece that payloads do not have")) << error.what;
}

TEST(StoreDamage, HugeClaimsOfVersion1AreRefused)
{
  const std::string path = temporaryPath("huge.pfront");
  const auto refused = [&](const char* what, const auto& change)
  {
    ForgedStore forged(goldenFile("version1.pfront"));
    change(forged);
    forged.write(path);
    EXPECT_EQ(openFails(path).kind, Error::Kind::Corrupt) << what;
  };
  refused("nodes", [](ForgedStore& f) { f.footer.nodeCount = 0xffffffffu; });
  refused("points of a node",
    [](ForgedStore& f)
    {
      std::vector<Node> nodes = decodeNodeTable(
        f.section(SectionKind::NodeTable).data(), f.footer.nodeCount, NodeRowForm::Plain);
      nodes[4].pointCount = 0xffffffffu;
      f.footer.pointCount += nodes[4].pointCount - nodes[4].pointsBelow;
      nodes[4].pointsBelow = nodes[4].pointCount;
      nodes[1].pointsBelow = nodes[4].pointCount;
      f.replaceSection(SectionKind::NodeTable, encodeNodeTable(nodes, NodeRowForm::Plain));
    });
  refused("payload offset",
    [](ForgedStore& f)
    {
      std::vector<std::byte> directory = f.section(SectionKind::BlockDirectory);
      poke(directory, f.footer.nodeCount * 24u, UINT64_MAX - 5);
      f.replaceSection(SectionKind::BlockDirectory, directory);
    });
  refused("block size",
    [](ForgedStore& f)
    {
      std::vector<std::byte> directory = f.section(SectionKind::BlockDirectory);
      poke(directory, f.footer.nodeCount * 32u, 0xffffffffu);
      f.replaceSection(SectionKind::BlockDirectory, directory);
    });
  refused("origin",
    [](ForgedStore& f)
    {
      std::vector<std::byte> directory = f.section(SectionKind::BlockDirectory);
      poke(directory, 0, INT64_MAX);
      f.replaceSection(SectionKind::BlockDirectory, directory);
    });
}

// Every four bytes of the description set to the largest number: lengths, counts, types.
TEST(StoreDamage, ForgedDescriptionsNeverCrash)
{
  const std::string sound = soundStore(2);
  const std::string path = temporaryPath("described.pfront");
  ForgedStore forged(sound);
  const std::vector<std::byte> honest = forged.section(SectionKind::Description);
  std::size_t refused = 0;
  for (std::size_t at = 0; at + 4 <= honest.size(); ++at)
  {
    std::vector<std::byte> description = honest;
    poke(description, at, 0xffffffffu);
    forged.replaceSection(SectionKind::Description, description);
    forged.write(path);
    const auto opened = PointStore::open(path);
    if (opened)
    {
      EXPECT_TRUE((*opened)->verify());
    }
    else
    {
      EXPECT_EQ(opened.error().kind, Error::Kind::Corrupt);
      ++refused;
    }
  }
  EXPECT_GT(refused, 100u);
}

} // namespace pointfront
