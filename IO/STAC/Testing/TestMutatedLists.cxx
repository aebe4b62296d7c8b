#include "ItemCollection.h"

#include "RandomRounds.h"
#include "TextMutation.h"

#include <gtest/gtest.h>

#include <cstddef>
#include <string>
#include <vector>

namespace pointfront
{
namespace
{
/// One of each kind of fact that a list may have.
const std::string sound =
  R"({"type": "FeatureCollection", "links": [{"rel": "next", "href": "b"}], "features": [
  {"type": "Feature", "id": "a", "properties": {"pc:count": 7, "proj:bbox": [1, 2, 3, 4.5, 5, 6],
   "proj:wkt2": "PROJCRS[]", "pc:schemas": [{"name": "X", "size": 4}]},
   "assets": {"data": {"href": "./a.copc.laz", "roles": ["data"]}, "view": {"href": "a.png"}}},
  {"type": "Feature", "id": "b", "properties": {"proj:bbox": [1, 2, 4, 5], "proj:epsg": 25832,
   "pc:statistics": [{"name": "Z", "minimum": -3, "maximum": 9}]},
   "assets": {"points": {"href": "https://host/b/../c?sig=1", "pc:count": 1e3,
              "type": "application/vnd.laszip+copc"}}}]})";

const std::vector<const char*> words = { "null", "[]", "{}", "-1", "1e999", "\"\"", "\\u0000",
  "18446744073709551616", "[[[[[[[[", "../../", "file:///", "\xff\xfe", "://", "true", "#far:" };

void expectSound(const ItemCollection& list, unsigned seed)
{
  EXPECT_FALSE(list.items.empty()) << seed;
  for (const STACItem& item : list.items)
  {
    EXPECT_FALSE(item.href.empty()) << seed;
    EXPECT_TRUE(!item.bounds || !item.bounds->empty()) << seed;
    EXPECT_TRUE(!item.points || *item.points <= std::uint64_t(1) << 48) << seed;
    const bool sets = item.href.find("#far:") != std::string::npos;
    EXPECT_TRUE(sets || resolvedHref("a/list.vpc", item.href)) << seed;
    const Result<std::string> far = resolvedHref("https://host/a/list.vpc", item.href);
    EXPECT_TRUE(!far || far->find("://") != std::string::npos) << seed << ": " << *far;
    EXPECT_TRUE(!far || far->find("#far:") == std::string::npos) << seed << ": " << *far;
  }
}
} // namespace

/// The fuzz target `fuzz-itemcollection` looks for more.
TEST(ItemCollection, MutatedListsAreReadOrSayWhy)
{
  ASSERT_TRUE(ItemCollection::parse(sound, "x.vpc"));
  unsigned taken = 0;
  const unsigned rounds = test::randomRounds(2000);
  for (unsigned seed = 0; seed < rounds; ++seed)
  {
    test::TextMutation mutation(seed, words);
    const Result<ItemCollection> list = ItemCollection::parse(mutation.of(sound), "x.vpc");
    taken += list ? 1 : 0;
    if (list)
    {
      expectSound(*list, seed);
    }
    else
    {
      EXPECT_EQ(list.error().kind, Error::Kind::BadFormat) << seed;
      EXPECT_EQ(list.error().what.compare(0, 6, "x.vpc:"), 0) << seed << ": " << list.error().what;
    }
  }
  EXPECT_GT(taken, rounds / 20); // these reach what is read of an item
  EXPECT_LT(taken, rounds);
}

} // namespace pointfront
