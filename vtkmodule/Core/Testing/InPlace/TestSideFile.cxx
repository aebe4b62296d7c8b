#include "pointfront/InPlace/SideFile.h"

#include "GoldenFiles.h"
#include "MadeUpRecords.h"
#include "SampleStore.h"
#include "SplatPatterns.h"

#include "pointfront/Codec/Checksum.h"
#include "pointfront/InPlace/NodePoints.h"

#include <glm/vector_relational.hpp>
#include <gtest/gtest.h>

#include <set>

namespace pointfront
{
namespace
{
const QuantisationGrid grid{ glm::dvec3(0.01), glm::dvec3(1000.0, 2000.0, 0.0) };

struct Made
{
  std::string path;
  std::uint64_t bytes = 0;
  std::uint64_t spilled = 0;
};

/// A held attribute: the low bits of each point's number.
ValueBlock lowBits(const std::vector<std::uint64_t>& points, SideFileWriter& writer)
{
  std::vector<std::uint16_t> values(points.begin(), points.end());
  const CodedBlock coded =
    encodeBlock(reinterpret_cast<const std::byte*>(values.data()), { values.size(), 1, 2 });
  const auto offset = writer.append(coded.bytes);
  EXPECT_TRUE(offset);
  return { *offset, static_cast<std::uint32_t>(coded.bytes.size()),
    checksumOf(coded.bytes.data(), coded.bytes.size()), coded.codec };
}

/// The side file of these records, with or without a held attribute.
Made index(const MadeUpRecords& records, const std::string& name, unsigned threads = 2,
  std::uint64_t memoryBytes = std::uint64_t(64) << 20, std::uint32_t leafPoints = 500,
  bool held = false)
{
  Made made{ temporaryPath(name) };
  auto writer = SideFileWriter::create(made.path);
  EXPECT_TRUE(writer);
  InPlaceOptions options;
  options.leafPoints = leafPoints;
  options.memoryBytes = memoryBytes;
  options.temporaryFolder = made.path.substr(0, made.path.rfind('/'));
  WorkCrew crew(threads, {});
  const GridRecords view = records.view();
  std::vector<ValueBlock> blocks;
  auto table = indexInPlace(
    view, records.box(), grid, options, crew, [](auto, auto) {},
    [&](const InPlaceTable& nodes, NodeIndex node, const std::vector<std::byte>& list)
    {
      const auto offset = (*writer)->append(list);
      if (held)
      {
        const auto points = pointsOfList(nodes, node, list, view.count);
        EXPECT_TRUE(points);
        blocks.push_back(lowBits(*points, **writer));
      }
      return offset;
    });
  EXPECT_TRUE(table) << table.error().what;
  SideFileContent content;
  content.indexed.name = "points.las";
  content.indexed.points = view.count;
  content.stored.description.grid = grid;
  content.stored.description.structure = "inplace";
  content.stored.description.layers.push_back({ 0, "all", 0, 0 });
  content.leafPoints = leafPoints;
  made.spilled = table->spilledBytes;
  content.table = std::move(*table);
  if (held)
  {
    content.table.blocks = std::move(blocks);
    content.held = 1;
    content.stored.description.schema.add({ "low_bits", ScalarType::UInt16, 1 });
    content.stored.description.ranges.push_back({ { { 0.0, 65535.0 } } });
  }
  EXPECT_TRUE((*writer)->commit(content));
  made.bytes = (*writer)->bytesWritten();
  return made;
}

/// Every point in exactly one node, inside its box and all boxes above.
void expectWhole(const MadeUpRecords& records, const std::string& path)
{
  const auto side = SideFile::open(path);
  ASSERT_TRUE(side) << side.error().what;
  const InPlaceTable& table = (*side)->content().table;
  const GridRecords view = records.view();
  std::vector<bool> seen(view.count);
  std::uint64_t found = 0;
  for (NodeIndex i = 0; i < table.nodes.size(); ++i)
  {
    const auto points = (*side)->pointsOf(i);
    ASSERT_TRUE(points) << points.error().what;
    ASSERT_EQ(points->size(), table.nodes[i].pointCount);
    for (const std::uint64_t point : *points)
    {
      ASSERT_FALSE(seen[point]) << "point " << point << " again in node " << i;
      seen[point] = true;
      ++found;
      const glm::dvec3 world = grid.toWorld(GridPosition(view.position(point)));
      for (NodeIndex above = i; above != noNode; above = table.nodes[above].parent)
      {
        Bounds box = table.nodes[above].box();
        box.low -= 1e-9;
        box.high += 1e-9;
        ASSERT_TRUE(box.contains(world)) << "point " << point << ", node " << above;
      }
      ASSERT_TRUE(glm::all(glm::greaterThanEqual(view.position(point), table.rows[i].low)));
    }
  }
  EXPECT_EQ(found, view.count);
}

TEST(InPlaceTable, FlightStripsAreWholeAndCostLittle)
{
  const MadeUpRecords records = MadeUpRecords::strips(100000, 1);
  const Made made = index(records, "strips.pfindex");
  expectWhole(records, made.path);
  EXPECT_LT(made.bytes, 100000u); // below a byte a point
}

// Flight lines 1 : 2; the leaves' discs close them.
TEST(InPlaceTable, EveryNodeSaysHowLargeSplatsAre)
{
  test::SplatPatterns patterns(1);
  const std::vector<glm::dvec3> plane = patterns.scanLines(40000, 2.0);
  MadeUpRecords records;
  for (const glm::dvec3& p : plane)
  {
    const glm::dvec3 steps = p * 1e6;
    records.add(static_cast<int>(steps.x), static_cast<int>(steps.y), 0);
  }
  const double h = 1e6 / std::sqrt(double(plane.size())) * grid.scale.x;
  std::vector<float> first;
  for (const unsigned threads : { 1u, 4u })
  {
    const auto side =
      SideFile::open(index(records, "lines.pfindex", threads, std::uint64_t(64) << 20, 2000).path);
    ASSERT_TRUE(side);
    std::vector<float> radii;
    for (const Node& node : (*side)->content().table.nodes)
    {
      radii.push_back(node.splatRadius);
      if (node.leaf())
      {
        EXPECT_NEAR(node.splatRadius, 1.03 * h, 0.15 * h);
      }
      else
      {
        EXPECT_GT(node.splatRadius, 1.3 * h);
      }
    }
    first = first.empty() ? radii : first;
    EXPECT_EQ(radii, first) << threads;
  }
}

TEST(InPlaceTable, PointsThatShareAPlaceCountOnce)
{
  const MadeUpRecords once = MadeUpRecords::scattered(20000, 12);
  const auto spacings = [](const MadeUpRecords& records, std::uint32_t leafPoints)
  {
    const auto side = SideFile::open(index(records, "d.pfindex", 2, 1u << 26, leafPoints).path);
    return (*side)->content().table.nodes;
  };
  const std::vector<Node> of = spacings(once, 500);
  const std::vector<Node> twice = spacings(once.doubled(), 1000);
  ASSERT_EQ(of.size(), twice.size());
  for (std::size_t i = 0; i < of.size(); ++i)
  {
    EXPECT_NEAR(twice[i].spacing / of[i].spacing, of[i].leaf() ? 1.0 : 0.7, 0.13) << i;
  }
}

TEST(InPlaceTable, NoOrderIsWholeAndBounded)
{
  const MadeUpRecords records = MadeUpRecords::scattered(100000, 2);
  const Made made = index(records, "scattered.pfindex");
  expectWhole(records, made.path);
  EXPECT_LT(made.bytes, 300000u); // below three bytes a point
}

TEST(InPlaceTable, FewAndEqualPoints)
{
  MadeUpRecords records;
  expectWhole(records, index(records, "none.pfindex").path);
  records.add(-2147483647 - 1, 2147483647, 5);
  expectWhole(records, index(records, "one.pfindex").path);
  records.add(2147483647, -2147483647 - 1, 5);
  expectWhole(records, index(records, "corners.pfindex").path);
  MadeUpRecords equal;
  for (int i = 0; i < 5000; ++i)
  {
    equal.add(3, 3, 3);
  }
  expectWhole(equal, index(equal, "equal.pfindex").path);
  for (int i = 0; i < 200000; ++i) // more than 255 slices of 500
  {
    equal.add(3, 3, i);
  }
  expectWhole(equal, index(equal, "wall.pfindex").path);
}

TEST(InPlaceTable, DenseSpotsAndFarOutliersAreWhole)
{
  MadeUpRecords records = MadeUpRecords::scattered(30000, 3);
  for (int i = 0; i < 40; ++i)
  {
    records.add(2000000000 - i, -2000000000, i);
  }
  expectWhole(records, index(records, "outliers.pfindex").path);
}

TEST(InPlaceTable, TheSameBytesForAnyThreadsAndMemory)
{
  const MadeUpRecords records = MadeUpRecords::scattered(200000, 4);
  const Made one = index(records, "one.pfindex", 1);
  const Made four = index(records, "four.pfindex", 4);
  const Made small = index(records, "small.pfindex", 3, 100000);
  EXPECT_EQ(one.spilled, 0u);
  EXPECT_GT(small.spilled, 100000u);
  EXPECT_EQ(fileBytes(one.path), fileBytes(four.path));
  EXPECT_EQ(fileBytes(one.path), fileBytes(small.path));
}

TEST(InPlaceTable, InnerNodesAreFairSubsets)
{
  const MadeUpRecords records = MadeUpRecords::scattered(64000, 5);
  const auto side = SideFile::open(index(records, "fair.pfindex").path);
  ASSERT_TRUE(side);
  const auto root = (*side)->pointsOf(0);
  ASSERT_TRUE(root);
  EXPECT_GE(root->size(), 125u);
  EXPECT_LE(root->size(), 251u);
  int quadrants[4] = {};
  std::set<std::uint64_t> steps;
  for (std::size_t i = 0; i < root->size(); ++i)
  {
    const glm::ivec3 p = records.view().position((*root)[i]);
    ++quadrants[(p.x > 0 ? 1 : 0) + (p.y > 0 ? 2 : 0)];
    steps.insert(i > 0 ? (*root)[i] - (*root)[i - 1] : 0);
  }
  for (const int count : quadrants)
  {
    EXPECT_NEAR(count, static_cast<double>(root->size()) / 4, 30.0);
  }
  EXPECT_GT(steps.size(), root->size() / 2); // a random step, not an equidistant one
}

TEST(SideFile, DamageIsTold)
{
  const MadeUpRecords records = MadeUpRecords::strips(20000, 6);
  const std::vector<std::byte> whole = fileBytes(index(records, "whole.pfindex").path);
  const std::string path = temporaryPath("damaged.pfindex");
  const auto kindOf = [&path](const std::vector<std::byte>& bytes)
  {
    writeFile(path, bytes);
    const auto side = SideFile::open(path);
    return side ? std::string("opens") : std::to_string(int(side.error().kind));
  };
  const auto kind = [](Error::Kind k) { return std::to_string(int(k)); };
  for (const std::size_t size :
    { std::size_t(9), std::size_t(63), std::size_t(64), whole.size() / 2, whole.size() - 1 })
  {
    std::vector<std::byte> cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    EXPECT_EQ(kindOf(cut), kind(Error::Kind::Truncated)) << size;
    EXPECT_TRUE(SideFile::looksLikeSideFile(path));
  }
  EXPECT_EQ(kindOf({}), kind(Error::Kind::BadFormat));
  std::vector<std::byte> longer = whole;
  longer.push_back({});
  EXPECT_EQ(kindOf(longer), kind(Error::Kind::Corrupt));
  for (const std::size_t at : { std::size_t(8), std::size_t(40), whole.size() - 100 })
  {
    std::vector<std::byte> flipped = whole;
    flipped[at] ^= std::byte(4);
    EXPECT_EQ(kindOf(flipped), kind(Error::Kind::Corrupt)) << at;
  }
}

// Kept for ever: written by the program before rows said how large splats are.
TEST(SideFile, Version1StaysReadable)
{
  const auto side = SideFile::open(goldenFile("version1.pfindex"));
  ASSERT_TRUE(side) << side.error().what;
  const SideFileContent& content = (*side)->content();
  EXPECT_EQ(content.stored.description.version, 1u);
  EXPECT_EQ(content.indexed.points, 2000u);
  EXPECT_GT(content.table.nodes.size(), 5u);
  std::uint64_t points = 0;
  for (NodeIndex i = 0; i < content.table.nodes.size(); ++i)
  {
    EXPECT_EQ(content.table.nodes[i].splatRadius, 0.0f);
    EXPECT_GT(content.table.nodes[i].spacing, 0.0f);
    const auto own = (*side)->pointsOf(i);
    ASSERT_TRUE(own) << own.error().what;
    points += own->size();
  }
  EXPECT_EQ(points, 2000u);
}

TEST(SideFile, ANewerVersionIsRefusedWithAdvice)
{
  const MadeUpRecords records = MadeUpRecords::strips(1000, 7);
  std::vector<std::byte> bytes = fileBytes(index(records, "whole.pfindex").path);
  bytes[8] = std::byte(sideFileVersion + 1);
  const std::uint32_t checksum = checksumOf(bytes.data(), 60);
  std::memcpy(bytes.data() + 60, &checksum, sizeof checksum);
  const std::string path = temporaryPath("newer.pfindex");
  writeFile(path, bytes);
  const auto side = SideFile::open(path);
  ASSERT_FALSE(side);
  EXPECT_EQ(side.error().kind, Error::Kind::Unsupported);
  EXPECT_NE(side.error().what.find("up to version 3"), std::string::npos);
  EXPECT_NE(side.error().what.find("update PointFront"), std::string::npos);
}

// A program that knows no held attributes reads a file that has none.
TEST(SideFile, AVersionIsNoNewerThanWhatTheFileHolds)
{
  const MadeUpRecords records = MadeUpRecords::strips(20000, 9);
  const std::string without = index(records, "without.pfindex").path;
  const std::string with =
    index(records, "with.pfindex", 2, std::uint64_t(64) << 20, 500, true).path;
  EXPECT_EQ(fileBytes(without)[8], std::byte(2));
  EXPECT_EQ(fileBytes(with)[8], std::byte(3));
  expectWhole(records, with);
}

TEST(SideFile, AHeldAttributeIsThatOfEachPoint)
{
  const MadeUpRecords records = MadeUpRecords::scattered(100000, 10);
  std::vector<std::vector<std::byte>> files;
  for (const unsigned threads : { 1u, 2u, 7u })
  {
    const std::string path =
      index(records, "held.pfindex", threads, std::uint64_t(1) << 20, 500, true).path;
    files.push_back(fileBytes(path));
    EXPECT_EQ(files.back(), files.front()) << threads;
    const auto side = SideFile::open(path);
    ASSERT_TRUE(side) << side.error().what;
    for (NodeIndex i = 0; i < (*side)->content().table.nodes.size(); ++i)
    {
      const auto points = (*side)->pointsOf(i);
      const auto coded = (*side)->blockOf(i, 0);
      ASSERT_TRUE(points && coded);
      EXPECT_EQ(coded->size, (*side)->blockBytes(i, 0));
      const auto values = (*side)->decodeBlock(i, 0, *coded);
      ASSERT_TRUE(values) << values.error().what;
      const std::vector<std::uint16_t> expected(points->begin(), points->end());
      ASSERT_EQ(values->size(), 2 * expected.size());
      EXPECT_TRUE(expected.empty() || // memcmp() takes no null
        std::memcmp(values->data(), expected.data(), values->size()) == 0)
        << i;
    }
  }
}

TEST(SideFile, DamageOfHeldAttributesIsTold)
{
  const MadeUpRecords records = MadeUpRecords::strips(20000, 11);
  const std::string path =
    index(records, "held.pfindex", 2, std::uint64_t(64) << 20, 500, true).path;
  const std::vector<std::byte> whole = fileBytes(path);
  const auto sound = SideFile::open(path);
  ASSERT_TRUE(sound);
  const ValueBlock block = (*sound)->content().table.blocks[3];
  const std::size_t nodes = (*sound)->content().table.nodes.size();

  std::vector<std::byte> flipped = whole;
  flipped[block.offset + block.bytes / 2] ^= std::byte(1);
  writeFile(path, flipped);
  const auto side = SideFile::open(path);
  ASSERT_TRUE(side);
  const auto coded = (*side)->blockOf(3, 0);
  ASSERT_TRUE(coded);
  const auto values = (*side)->decodeBlock(3, 0, *coded);
  ASSERT_FALSE(values);
  EXPECT_EQ(values.error().kind, Error::Kind::Corrupt);
  EXPECT_NE(values.error().what.find("node 3, attribute 'low_bits'"), std::string::npos);

  // Somebody who keeps the checksums: rows of 24 bytes and the count before them end the file.
  const auto sealed = [&](std::size_t behindEnd, std::uint8_t value)
  {
    std::vector<std::byte> bytes = whole;
    bytes[bytes.size() - behindEnd] = std::byte(value);
    std::uint64_t table = 0;
    std::memcpy(&table, bytes.data() + 24, sizeof table);
    const std::uint32_t ofTable = checksumOf(bytes.data() + table, bytes.size() - table);
    std::memcpy(bytes.data() + 40, &ofTable, sizeof ofTable);
    const std::uint32_t ofHeader = checksumOf(bytes.data(), 60);
    std::memcpy(bytes.data() + 60, &ofHeader, sizeof ofHeader);
    writeFile(path, bytes);
    const auto opened = SideFile::open(path);
    return opened ? std::string("opens") : opened.error().what;
  };
  EXPECT_NE(sealed(24 * nodes + 4, 2).find("are not those"), std::string::npos);
  EXPECT_NE(sealed(24 * nodes + 4, 0).find("are not those"), std::string::npos);
  EXPECT_NE(sealed(17, 1).find("outside the file"), std::string::npos); // an offset
  EXPECT_NE(sealed(13, 255).find("outside the file"), std::string::npos); // a size
  EXPECT_NE(sealed(8, 99).find("unknown way"), std::string::npos);
}

TEST(SideFile, ADamagedListNamesItsNode)
{
  const MadeUpRecords records = MadeUpRecords::strips(20000, 8);
  const std::string whole = index(records, "whole.pfindex").path;
  std::vector<std::byte> bytes = fileBytes(whole);
  const auto sound = SideFile::open(whole);
  ASSERT_TRUE(sound);
  const InPlaceRow& row = (*sound)->content().table.rows[3];
  ASSERT_GT(row.bytes, 0u);
  bytes[row.offset] ^= std::byte(1);
  const std::string path = temporaryPath("list.pfindex");
  writeFile(path, bytes);
  const auto side = SideFile::open(path);
  ASSERT_TRUE(side);
  EXPECT_TRUE((*side)->pointsOf(2));
  const auto points = (*side)->pointsOf(3);
  ASSERT_FALSE(points);
  EXPECT_EQ(points.error().kind, Error::Kind::Corrupt);
  EXPECT_NE(points.error().what.find("node 3"), std::string::npos);
}
} // namespace
} // namespace pointfront
