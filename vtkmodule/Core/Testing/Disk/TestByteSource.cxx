#include "CountedBytes.h"
#include "SampleStore.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Disk/ByteSource.h"
#include "pointfront/Disk/SmallFile.h"
#include "pointfront/Tiles/StoredCloudFormats.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

namespace pointfront
{
namespace
{

std::vector<std::byte> bytesOf(const std::string& text)
{
  const auto* first = reinterpret_cast<const std::byte*>(text.data());
  return { first, first + text.size() };
}

TEST(ByteSource, ReadsManyRangesOfAFile)
{
  const std::string path = temporaryPath("letters");
  writeFile(path, bytesOf("abcdefghij"));
  const auto source = openBytes(path);
  ASSERT_TRUE(source) << source.error().what;
  EXPECT_EQ((*source)->bytes(), 10u);
  EXPECT_EQ((*source)->path(), path);
  std::string first(2, ' ');
  std::string second(3, ' ');
  const ByteRange ranges[] = { { 7, 3, reinterpret_cast<std::byte*>(second.data()) },
    { 0, 2, reinterpret_cast<std::byte*>(first.data()) } };
  const Result<void> done = (*source)->read(ranges, 2);
  ASSERT_TRUE(done) << done.error().what;
  EXPECT_EQ(first, "ab");
  EXPECT_EQ(second, "hij");
  const Result<RawBytes> behind = (*source)->readAt(8, 3);
  ASSERT_FALSE(behind);
  EXPECT_EQ(behind.error().kind, Error::Kind::Truncated);
}

TEST(ByteSource, AnAddressOfAnUnknownSchemeIsNoPath)
{
  const auto source = openBytes("gopher://host/cloud.pfront");
  ASSERT_FALSE(source);
  EXPECT_EQ(source.error().kind, Error::Kind::Unsupported);
  EXPECT_NE(source.error().what.find("gopher"), std::string::npos) << source.error().what;
  EXPECT_EQ(openBytes("no/such.pfront").error().kind, Error::Kind::NotFound);
}

TEST(ByteSource, TheSchemeOfAnAddress)
{
  EXPECT_EQ(schemeOf("https://host/a"), "https");
  EXPECT_EQ(schemeOf("S3://bucket/key"), "s3");
  EXPECT_EQ(schemeOf("a/b://c"), "");
  EXPECT_EQ(schemeOf("://c"), "");
  EXPECT_EQ(schemeOf("C:/clouds/a.pfront"), "");
  EXPECT_EQ(schemeOf(""), "");
}

TEST(ByteSource, WhatLiesBesideAnAddress)
{
  EXPECT_EQ(beside("a/ept.json", "ept-data/0.laz"), "a/ept-data/0.laz");
  EXPECT_EQ(beside("ept.json", "x"), "x");
  EXPECT_EQ(beside("a/list", "/b/c"), "/b/c");
  EXPECT_EQ(beside("https://h/a/ept.json?sig=1/2", "d/0.laz"), "https://h/a/d/0.laz?sig=1/2");
  EXPECT_EQ(beside("https://h", "d"), "https://h/d");
  EXPECT_EQ(beside("a/list", "https://h/b"), "https://h/b");
  // A path is no part of an address as it stands.
  EXPECT_EQ(beside("a/list", "b c#1?%20"), "a/b c#1?%20");
  EXPECT_EQ(beside("https://h/a/list?sig=1", "b c#1?%20\xc3\xbc+"),
    "https://h/a/b%20c%231%3F%2520%C3%BC%2B?sig=1");
  EXPECT_EQ(beside("https://h/a/list", "it's (b),c;d=e&f:g@h!$*~"),
    "https://h/a/it's%20(b),c;d=e&f:g@h!$*~");
  EXPECT_EQ(beside("https://h/a/list", "./../b/./c"), "https://h/b/c");
  EXPECT_EQ(beside("https://h/a/list", "../../../c"), "https://h/c");
  // The epoch of a collection comes last, as in its address.
  EXPECT_EQ(beside("https://h/a/list?sig=1", "c d.pfcollection#epoch=2024"),
    "https://h/a/c%20d.pfcollection?sig=1#epoch=2024");
  // A preview names its store so: a name sets nothing, behind an epoch either.
  EXPECT_EQ(beside("https://h/a/x", "b#far:cache=c"), "https://h/a/b%23far:cache=c");
  EXPECT_EQ(
    beside("https://h/a/x", "b#epoch=1#far:cache=c"), "https://h/a/b%23epoch=1%23far:cache=c");
}

/// A store behind an address is the store of the file: all nodes, and the same bytes.
TEST(ByteSource, AStoreOpensByItsAddress)
{
  const auto counts = CountedBytes::add();
  const std::string path = temporaryPath("sample.pfront");
  writeSample(makeSample(50), path);
  const std::string address = CountedBytes::addressOf(path);
  const auto near = StoredCloudFormats::ofProcess().open(path);
  const auto far = StoredCloudFormats::ofProcess().open(address);
  ASSERT_TRUE(near) << near.error().what;
  ASSERT_TRUE(far) << far.error().what;
  EXPECT_EQ((*far)->description().path, address);
  EXPECT_GT(counts->rounds(), 0u);
  const ColumnSelection columns = everyColumn((*near)->description().schema);
  for (NodeIndex node = 0; node < (*near)->hierarchy()->nodeCount(); ++node)
  {
    const Result<NodeColumns> expected = (*near)->read(node, columns);
    const Result<NodeColumns> found = (*far)->read(node, columns);
    ASSERT_TRUE(expected && found);
    EXPECT_EQ(found->positions, expected->positions);
    EXPECT_EQ(found->columns, expected->columns);
  }
}

TEST(ByteSource, ASmallFileByItsAddress)
{
  CountedBytes::add();
  const std::string path = temporaryPath("text");
  writeFile(path, bytesOf("{}"));
  const Result<std::string> text = readSmallText(CountedBytes::addressOf(path), 10);
  ASSERT_TRUE(text) << text.error().what;
  EXPECT_EQ(*text, "{}");
}

} // namespace
} // namespace pointfront
