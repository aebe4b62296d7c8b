#include "Address.h"
#include "RemoteOpener.h"

#include "pointfront/Disk/ByteOpeners.h"

#include <gtest/gtest.h>

#include <string>

namespace pointfront
{
namespace
{
std::string remembered(const std::string& text)
{
  const Result<Address> address = Address::parse(text);
  EXPECT_TRUE(address) << text;
  return address ? rememberAddress(*address) : std::string();
}

std::string placeOf(const std::string& text)
{
  const Result<Address> address = Address::parse(text);
  return address ? address->place() : std::string();
}
} // namespace

TEST(Address, ThePublicFormHasNoSecretAndLeadsBack)
{
  const std::string whole = "https://me:pass@Example.org/a/b.pfront?X-Amz-Signature=hidden";
  const std::string form = remembered(whole);
  for (const char* const secret : { "me:", "pass", "hidden", "Amz" })
  {
    EXPECT_EQ(form.find(secret), std::string::npos) << form;
  }
  EXPECT_EQ(addressOf(form), "https://me:pass@example.org/a/b.pfront?X-Amz-Signature=hidden");
  EXPECT_EQ(remembered(addressOf(form)), form);
}

TEST(Address, WhatLiesBesideHasTheSameSecrets)
{
  const std::string tree = remembered("https://host/a/ept.json?token=x");
  EXPECT_EQ(
    addressOf(beside(tree, "ept-data/0-0-0-0.laz")), "https://host/a/ept-data/0-0-0-0.laz?token=x");
  const std::string folder = remembered("https://me:pass@host/a/list.pfronts");
  EXPECT_EQ(addressOf(beside(folder, "one.pfront")), "https://me:pass@host/a/one.pfront");
  // Not those of another host.
  const std::string mark = tree.substr(tree.find('?'));
  EXPECT_EQ(addressOf("https://other/a/ept.json" + mark), "https://other/a/ept.json" + mark);
}

TEST(Address, OtherSecretsAreOtherClouds)
{
  EXPECT_NE(remembered("https://host/a?v=1"), remembered("https://host/a?v=2"));
  EXPECT_NE(remembered("https://me:one@host/a"), remembered("https://me:other@host/a"));
  EXPECT_EQ(remembered("https://host/a"), "https://host/a");
}

TEST(Address, SettingsTravelWithTheName)
{
  addRemoteOpeners();
  const std::string plain = "https://host/a/list.vpc";
  const std::string form = remembered(plain + "#far:offline=1&timeout=5");
  EXPECT_EQ(form.find("offline"), std::string::npos) << form;
  EXPECT_NE(form, plain);
  EXPECT_NE(form, remembered(plain + "#far:offline=1"));
  EXPECT_EQ(addressOf(form), plain + "#far:offline=1&timeout=5");
  EXPECT_EQ(Address::parse(addressOf(form))->text(), plain);
  EXPECT_EQ(placeOf(addressOf(form)), plain);
  // They are those of what it names, wherever that lies.
  EXPECT_EQ(addressOf(beside(form, "b.laz")), "https://host/a/b.laz#far:offline=1&timeout=5");
  EXPECT_EQ(addressOf(beside(form, "https://other/b.laz?sig=1")),
    "https://other/b.laz?sig=1#far:offline=1&timeout=5");
  // A file sets nothing itself, whether the user has set something or not.
  EXPECT_EQ(addressOf(beside(form, "https://other/b.laz#far:offline=0")),
    "https://other/b.laz#far:offline=1&timeout=5");
  EXPECT_EQ(addressOf(beside(plain, "https://other/b.laz#far:cache=/tmp")), "https://other/b.laz");
  const std::string city = "https://other/c.pfcollection";
  EXPECT_EQ(beside(form, city + "#epoch=1"), beside(form, city) + "#epoch=1");
  EXPECT_EQ(beside(plain, "https://other/b.laz"), "https://other/b.laz");
}

TEST(Address, ARedirectionSetsNothing)
{
  const Address from = Address::parse("https://host/a/b#far:offline=1").value();
  for (const char* to : { "https://other/c#far:cache=/tmp", "//other/c#far:cache=/tmp",
         "/c#far:cache=/tmp", "c#far:cache=/tmp" })
  {
    const Result<Address> next = from.redirected(to);
    ASSERT_TRUE(next) << to;
    EXPECT_EQ(next->settings, "") << to;
    EXPECT_EQ(next->path.back(), 'c') << to;
  }
}

TEST(Address, ARedirectionOfTheSameServerKeepsTheUser)
{
  const Address from = Address::parse("https://me:pass@host/a/b?v=1").value();
  const auto next = [&from](const char* to) { return from.redirected(to).value().text(); };
  EXPECT_EQ(next("/c"), "https://me:pass@host/c");
  EXPECT_EQ(next("c"), "https://me:pass@host/a/c");
  EXPECT_EQ(next("https://HOST/c"), "https://me:pass@host/c");
  EXPECT_EQ(next("https://you:x@host/c"), "https://you:x@host/c");
  EXPECT_EQ(next("http://host/c"), "http://host/c");
  EXPECT_EQ(next("https://host:8443/c"), "https://host:8443/c");
  EXPECT_EQ(next("//other/c"), "https://other/c");
}

TEST(Address, ARedirectionIsReadAsBrowsersReadIt)
{
  const Address from = Address::parse("https://host/a/b?v=1").value();
  const auto next = [&from](const char* to) { return from.redirected(to).value().text(); };
  EXPECT_EQ(next("?x=1"), "https://host/a/b?x=1");
  EXPECT_EQ(next("/ok?from=http://h/"), "https://host/ok?from=http://h/");
  EXPECT_EQ(next("ok?from=http://h/"), "https://host/a/ok?from=http://h/");
  EXPECT_EQ(next("/with blank"), "https://host/with%20blank");
  EXPECT_FALSE(from.redirected(""));
}

/// Only what lies on the same server.
TEST(Address, AWholeAddressOfTheSameServerHasTheUserOfItsList)
{
  addRemoteOpeners();
  const std::string list = remembered("https://me:pass@host/a/list.vpc");
  EXPECT_EQ(addressOf(beside(list, "https://host/b?v=1")), "https://me:pass@host/b?v=1");
  EXPECT_EQ(addressOf(beside(list, "https://you:x@host/b")), "https://you:x@host/b");
  for (const char* other : { "https://host:8443/b", "http://host/b", "https://other/b" })
  {
    EXPECT_EQ(addressOf(beside(list, other)), other);
  }
}

/// An epoch is a part of a collection's name; it was lost, and all tiles were taken.
TEST(Address, ThePublicFormKeepsAnEpoch)
{
  addRemoteOpeners();
  EXPECT_EQ(
    publicForm("https://host/a.pfcollection#epoch=2024"), "https://host/a.pfcollection#epoch=2024");
}

TEST(Address, APlaceIsTheSameWhoeverSignsForIt)
{
  const std::string plain = "https://host/a";
  EXPECT_EQ(placeOf("https://me:pass@host/a?X-Amz-Signature=1&sig=2"), plain);
  for (const char* const query : { "sig=1", "sv=2024-11-04&sr=b&st=now&se=then&sp=r&sig=1",
         "X-Goog-Algorithm=A&x-goog-signature=1", "Policy=p&Signature=1&Key-Pair-Id=K",
         "Expires=9&Signature=1&Key-Pair-Id=K", "AWSAccessKeyId=A&Signature=1&Expires=9",
         "GoogleAccessId=A&Expires=9&Signature=1", "OSSAccessKeyId=A&Expires=9&Signature=1" })
  {
    EXPECT_EQ(placeOf(plain + '?' + query), plain) << query;
    EXPECT_EQ(placeOf(plain + "?v=2&" + query), placeOf(plain + "?v=2")) << query;
  }
  EXPECT_NE(placeOf("https://host/a?v=2"), placeOf("https://host/a?v=3"));
  EXPECT_EQ(placeOf("https://host/a?v=hidden").find("hidden"), std::string::npos);
}

/// "?key=a.pfront" is the name of a file for many a server.
TEST(Address, APartOfAQueryThatIsNoSignatureForSureMayChooseTheFile)
{
  for (const char* const name : { "key", "token", "st", "se", "sv", "sr", "ss", "policy", "auth",
         "signature", "expires", "Key-Pair-Id", "password", "AWSAccessKeyId" })
  {
    const std::string asked = std::string("https://host/get?") + name + '=';
    EXPECT_NE(placeOf(asked + "one.pfront"), placeOf(asked + "other.pfront")) << name;
    EXPECT_EQ(placeOf(asked + "one.pfront"), placeOf(asked + "one.pfront")) << name;
    EXPECT_EQ(placeOf(asked + "one.pfront").find("one"), std::string::npos) << name;
    EXPECT_NE(placeOf(asked + "one.pfront&x-amz-signature=1"), placeOf("https://host/get"));
  }
  // From 64 bits a short key could be told: nothing shorter than this stands for it.
  const std::string place = placeOf("https://host/get?key=a");
  EXPECT_EQ(place.size(), std::string("https://host/get?~").size() + 64);
}

} // namespace pointfront
