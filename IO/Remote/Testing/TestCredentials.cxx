#include "Address.h"
#include "Credentials.h"
#include "RemoteOptions.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace pointfront
{

TEST(Credentials, HeadersGoToTheirServerAlone)
{
  ASSERT_TRUE(learnCredentials("[https://One.example]\nAuthorization: Bearer a\nX-Key: 1\n"
                               "[http://two.example:81]\nX-Key: 2"));
  const auto headersOf = [](const char* text)
  {
    const auto request = requestOf(*Address::parse(text));
    return request ? request->headers : std::vector<std::string>{ request.error().what };
  };
  EXPECT_EQ(headersOf("https://one.example/a"),
    (std::vector<std::string>{ "Authorization: Bearer a", "X-Key: 1" }));
  EXPECT_EQ(headersOf("http://two.example:81/b"), std::vector<std::string>{ "X-Key: 2" });
  for (const char* const other : { "http://one.example/a", "https://two.example:81/b" })
  {
    EXPECT_TRUE(headersOf(other).empty()) << other;
  }
  ASSERT_TRUE(learnCredentials("[https://one.example]")); // it has none any more
  EXPECT_TRUE(headersOf("https://one.example/a").empty());
  EXPECT_FALSE(headersOf("http://two.example:81/b").empty());
}

TEST(Credentials, AMarkOfAnotherProcessLeadsToItsAddress)
{
  const std::string named = "https://three.example/a.pfront?~00112233445566ff";
  EXPECT_EQ(addressOf(named), named);
  ASSERT_TRUE(
    learnCredentials("~00112233445566ff https://me:pass@three.example/a.pfront?sig=secret"));
  EXPECT_EQ(addressOf(named), "https://me:pass@three.example/a.pfront?sig=secret");
  const std::string own = rememberAddress(*Address::parse(addressOf(named)));
  EXPECT_EQ(own.find("secret"), std::string::npos);
  EXPECT_EQ(addressOf(own), addressOf(named));
}

TEST(Credentials, WhatIsWrongIsAnErrorWithoutSecrets)
{
  for (const std::string wrong : { "Authorization: Bearer secret", "[https://h.example/secret]",
         "[secret]", "[https://h.example]\nsecret", "[https://h.example]\n: secret",
         "[https://h.example]\nA secret: b", "[https://h.example]\nA: secret\rB: c",
         "~0123 https://h.example/secret", "~00112233445566ff secret" })
  {
    const Result<void> learnt = learnCredentials(wrong);
    ASSERT_FALSE(learnt) << wrong;
    EXPECT_EQ(learnt.error().kind, Error::Kind::BadArgument);
    EXPECT_EQ(learnt.error().what.find("secret"), std::string::npos) << learnt.error().what;
    EXPECT_TRUE(headersFor("https://h.example").empty());
  }
}

TEST(RemoteOptions, OfSettingsThatSayNothingAreAFault)
{
  const std::pair<const char*, const char*> wrong[] = { { "POINTFRONT_REMOTE_TIMEOUT", "soon" },
    { "POINTFRONT_REMOTE_TIMEOUT", "60s" }, { "POINTFRONT_REMOTE_TIMEOUT", "0" },
    { "POINTFRONT_REMOTE_TIMEOUT", "nan" }, { "POINTFRONT_REMOTE_PRIVATE", "Refuse" } };
  for (const auto& [name, value] : wrong)
  {
    ::setenv(name, value, 1);
    const RemoteOptions options = RemoteOptions::ofEnvironment();
    ::unsetenv(name);
    ASSERT_TRUE(options.fault) << name << "=" << value;
    EXPECT_EQ(options.fault->kind, Error::Kind::BadArgument);
    EXPECT_NE(options.fault->what.find(name), std::string::npos);
    EXPECT_NE(options.fault->what.find(value), std::string::npos);
  }
  ::setenv("POINTFRONT_REMOTE_TIMEOUT", "2.5", 1);
  ::setenv("POINTFRONT_REMOTE_PRIVATE", "refuse", 1);
  const RemoteOptions options = RemoteOptions::ofEnvironment();
  ::unsetenv("POINTFRONT_REMOTE_TIMEOUT");
  ::unsetenv("POINTFRONT_REMOTE_PRIVATE");
  EXPECT_FALSE(options.fault);
  EXPECT_EQ(options.timeLimit.count(), 2500);
  EXPECT_TRUE(options.refusePrivate);
}

TEST(RemoteOptions, SectionsOfHeadersNameServers)
{
  const std::string file = testing::TempDir() + "pointfront_headers";
  const auto headersOf = [&](const std::string& section)
  {
    std::ofstream(file) << "# one\n[http://other.example]\nX-Key: 2\n" << section << "\nX-Key: 1\n";
    ::setenv("POINTFRONT_HTTP_HEADERS", file.c_str(), 1);
    const auto request = requestOf(*Address::parse("https://five.example:81/a"));
    ::unsetenv("POINTFRONT_HTTP_HEADERS");
    return request ? request->headers : std::vector<std::string>{ request.error().what };
  };
  for (const char* const right :
    { "[https://five.example:81]", "[https://five.example:81/]", "[HTTPS://Five.example:81//]" })
  {
    EXPECT_EQ(headersOf(right), std::vector<std::string>{ "X-Key: 1" }) << right;
  }
  EXPECT_TRUE(headersOf("[https://five.example/]").empty()) << "another port";
  for (const char* const wrong : { "[https://five.example:81/secret/]", "[five.example:81]", "[]",
         "[https://five.example:81?secret]", "[https://me:secret@five.example:81]" })
  {
    const std::vector<std::string> told = headersOf(wrong);
    ASSERT_EQ(told.size(), 1u) << wrong;
    EXPECT_NE(told.front().find("line 4 of '" + file), std::string::npos) << told.front();
    EXPECT_EQ(told.front().find("secret"), std::string::npos) << told.front();
  }
  std::remove(file.c_str());
}

} // namespace pointfront
