#include "ItemCollection.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <unistd.h>

namespace pointfront
{
namespace
{
/// An item with these properties and assets.
std::string item(const std::string& properties, const std::string& assets)
{
  return R"({"type": "Feature", "stac_version": "1.0.0", "id": "one", "properties": {)" +
    properties + R"(}, "assets": {)" + assets + "}}";
}

std::string collection(const std::string& items, const std::string& more = "")
{
  return R"({"type": "FeatureCollection", "features": [)" + items + "]" + more + "}";
}

const std::string data = R"("data": {"href": "./a.copc.laz", "roles": ["data"]})";

std::string refusal(const std::string& text)
{
  const Result<ItemCollection> list = ItemCollection::parse(text, "x.vpc");
  return list ? "taken" : list.error().what;
}

TEST(ItemCollection, AVirtualPointCloudTellsItsFiles)
{
  const auto list = ItemCollection::parse(
    collection(item(R"("pc:count": 7, "proj:bbox": [1, 2, 3, 4.5, 5, 6], "proj:wkt2": "PROJCRS[]",
                       "pc:schemas": [{"name": "X"}])",
      data)),
    "x.vpc");
  ASSERT_TRUE(list) << list.error().what;
  ASSERT_EQ(list->items.size(), 1u);
  const STACItem& one = list->items[0];
  EXPECT_EQ(one.name, "one");
  EXPECT_EQ(one.href, "./a.copc.laz");
  EXPECT_EQ(one.points, 7u);
  ASSERT_TRUE(one.bounds);
  EXPECT_EQ(one.bounds->low, glm::dvec3(1.0, 2.0, 3.0));
  EXPECT_EQ(one.bounds->high, glm::dvec3(4.5, 5.0, 6.0));
  EXPECT_EQ(one.system, "PROJCRS[]");
  EXPECT_EQ(one.kind, R"([{"name":"X"}])");
  EXPECT_TRUE(list->warnings.empty());
}

TEST(ItemCollection, AFlatBoxTakesTheHeightsOfTheStatistics)
{
  const std::string flat = R"("proj:bbox": [1, 2, 4, 5])";
  const auto without = ItemCollection::parse(collection(item(flat, data)), "x.vpc");
  ASSERT_TRUE(without);
  EXPECT_FALSE(without->items[0].bounds);
  EXPECT_FALSE(without->items[0].points);
  const auto with = ItemCollection::parse(
    collection(
      item(flat + R"(, "pc:statistics": [{"name": "Z", "minimum": -3, "maximum": 9}])", data)),
    "x.vpc");
  ASSERT_TRUE(with && with->items[0].bounds);
  EXPECT_EQ(with->items[0].bounds->low, glm::dvec3(1.0, 2.0, -3.0));
  EXPECT_EQ(with->items[0].bounds->high, glm::dvec3(4.0, 5.0, 9.0));
}

/// Facts may stand in the asset; a catalog's items have pictures and overviews, too.
TEST(ItemCollection, TheFileOfPointsIsFoundAmongTheAssets)
{
  const auto list = ItemCollection::parse(
    collection(item("", R"("thumbnail": {"href": "a.png", "roles": ["data"]},
                  "overview": {"href": "all.copc.laz", "roles": ["overview"]},
                  "laz": {"href": "a.laz"},
                  "points": {"href": "https://host/b?sig=1", "pc:count": 3,
                             "type": "application/vnd.laszip+copc"})") +
        "," + item("", R"("metadata": {"href": "a.json"})"),
      R"(, "links": [{"rel": "next", "href": "https://host/search?page=2"}])"),
    "x.json");
  ASSERT_TRUE(list) << list.error().what;
  ASSERT_EQ(list->items.size(), 1u);
  EXPECT_EQ(list->items[0].href, "https://host/b?sig=1");
  EXPECT_EQ(list->items[0].points, 3u);
  ASSERT_EQ(list->warnings.size(), 2u);
  EXPECT_NE(list->warnings[0].find("1 of its 2 items"), std::string::npos);
  EXPECT_NE(list->warnings[1].find("one page"), std::string::npos);
}

TEST(ItemCollection, OneItemIsAListOfOne)
{
  const auto list = ItemCollection::parse(item("", data), "x.json");
  ASSERT_TRUE(list) << list.error().what;
  EXPECT_EQ(list->items.size(), 1u);
}

TEST(ItemCollection, WhatIsNoListSaysWhy)
{
  EXPECT_NE(refusal("").find("no STAC ItemCollection"), std::string::npos);
  EXPECT_NE(refusal("[1]").find("no STAC ItemCollection"), std::string::npos);
  EXPECT_NE(refusal(R"({"type": "Collection"})").find("STAC Collection"), std::string::npos);
  EXPECT_NE(refusal(collection("")).find("no file of points"), std::string::npos);
  EXPECT_NE(refusal(collection("1, null, []")).find("none of its 3"), std::string::npos);
  for (const char* box :
    { "[1, 2]", "[1, 2, 3, 0, 5, 6]", "[1, 2, 3, 4, 5, \"6\"]", "[1, 2, 3, 1e300, 5, 6]", "7" })
  {
    const std::string why = refusal(collection(item(std::string("\"proj:bbox\": ") + box, data)));
    EXPECT_NE(why.find("item 'one'"), std::string::npos) << box << ": " << why;
    EXPECT_NE(why.find("proj:bbox"), std::string::npos) << why;
  }
  for (const char* count : { "-1", "1.5", "1e30", "\"many\"" })
  {
    const std::string why = refusal(collection(item(std::string("\"pc:count\": ") + count, data)));
    EXPECT_NE(why.find("pc:count"), std::string::npos) << count << ": " << why;
  }
}

TEST(ItemCollection, NamesAreThoseOfABrowser)
{
  const auto of = [](const std::string& path, const std::string& href)
  { return resolvedHref(path, href).value(); };
  EXPECT_EQ(of("a/all.vpc", "./b.copc.laz"), "a/b.copc.laz");
  EXPECT_EQ(of("all.vpc", "../b.copc.laz"), "../b.copc.laz");
  EXPECT_EQ(of("a/all.vpc", "/c/b.copc.laz"), "/c/b.copc.laz");
  EXPECT_EQ(of("a/all.vpc", "file:///c/b.copc.laz"), "/c/b.copc.laz");
  EXPECT_EQ(of("a/all.vpc", "/vsicurl/https://host/b.laz"), "https://host/b.laz");
  EXPECT_EQ(of("https://host/a/all.vpc?t=1", "./b.laz"), "https://host/a/b.laz?t=1");
  EXPECT_EQ(of("https://host/a/all.vpc", "../b/./c.laz?s=.."), "https://host/b/c.laz?s=..");
  EXPECT_EQ(of("https://host/a/all.vpc", "../../../c.laz"), "https://host/c.laz");
  EXPECT_EQ(of("https://host/a/all.vpc", "/c/b.laz"), "https://host/c/b.laz");
  EXPECT_EQ(of("https://host", "/b.laz"), "https://host/b.laz");
  EXPECT_EQ(of("https://host/a/all.vpc", "s3://bucket/b.laz"), "s3://bucket/b.laz");
  // As URIs, and not as paths.
  EXPECT_EQ(of("https://host/a/all.vpc?t=1", "b%20c.laz"), "https://host/a/b%20c.laz?t=1");
  EXPECT_EQ(of("https://host/a/all.vpc?t=1", "/b.laz"), "https://host/b.laz?t=1");
  EXPECT_EQ(of("https://host/a/all.vpc?t=1", "b.laz?u=2"), "https://host/a/b.laz?u=2");
  EXPECT_EQ(of("https://host/a/all.vpc?t=1", "b.laz#c"), "https://host/a/b.laz?t=1#c");
  EXPECT_EQ(of("https://host/a/all.vpc", "b c\xc3\xbc.laz"), "https://host/a/b%20c%C3%BC.laz");
  EXPECT_EQ(of("https://host/a/all.vpc", "100%.laz"), "https://host/a/100%25.laz");
  EXPECT_EQ(of("https://host/a/all.vpc", "//other:1/b/../c.laz"), "https://other:1/c.laz");
  EXPECT_EQ(of("http://host/all.vpc", "//other/c d"), "http://other/c%20d");
  EXPECT_EQ(of("https://host", "b.laz"), "https://host/b.laz");
  EXPECT_EQ(of("a/all.vpc", "https://host/b c.laz"), "https://host/b%20c.laz");
  const Result<std::string> stranger = resolvedHref("https://host/all.vpc", "file:///etc/passwd");
  ASSERT_FALSE(stranger);
  EXPECT_EQ(stranger.error().kind, Error::Kind::Unsupported);
}

/// Whoever serves or passes on a list does not choose how others read (FarSettings).
TEST(ItemCollection, NamesHaveNoSettings)
{
  for (const char* href : { "b.laz#far:cache=/tmp", "/b.laz#far:cache=/tmp", "//g/b#far:offline=1",
         "https://g/b.laz?sig=secret#far:cache=/tmp", "/vsicurl/https://g/b.laz#far:timeout=1",
         "b#epoch=1#far:cache=/tmp", "file:///b#far:offline=1" })
  {
    const Result<std::string> far = resolvedHref("https://host/all.vpc", href);
    ASSERT_FALSE(far) << href << ": " << *far;
    EXPECT_EQ(far.error().kind, Error::Kind::Unsupported);
    EXPECT_NE(far.error().what.find("settings"), std::string::npos) << far.error().what;
    EXPECT_EQ(far.error().what.find("secret"), std::string::npos) << far.error().what;
  }
  EXPECT_FALSE(resolvedHref("all.vpc", "https://g/b.laz#far:cache=/tmp"));
  EXPECT_FALSE(resolvedHref("all.vpc", "/vsicurl/https://g/b.laz#far:cache=/tmp"));
  EXPECT_EQ(resolvedHref("a/all.vpc", "b.laz#far:cache=c").value(), "a/b.laz#far:cache=c");
}

TEST(ItemCollection, AFileIsFoundAsItIsWrittenOrAsItsURISays)
{
  const std::string folder = testing::TempDir() + "/hrefs" + std::to_string(::getpid());
  std::filesystem::create_directories(folder);
  const auto of = [&folder](const std::string& href)
  { return resolvedHref(folder + "/all.vpc", href).value(); };
  EXPECT_EQ(of("a%20b.laz"), folder + "/a%20b.laz"); // nothing is there
  std::ofstream(folder + "/a b.laz") << "x";
  EXPECT_EQ(of("./a%20b.laz"), folder + "/a b.laz");
  EXPECT_EQ(of("a b.laz"), folder + "/a b.laz");
  EXPECT_EQ(of("a%20b.laz%00c"), folder + "/a%20b.laz%00c");
  EXPECT_EQ(of("file://" + folder + "/a%20b.laz"), folder + "/a b.laz");
  std::ofstream(folder + "/a%20b.laz") << "x";
  EXPECT_EQ(of("a%20b.laz"), folder + "/a%20b.laz");
  std::filesystem::remove_all(folder);
}
} // namespace
} // namespace pointfront
