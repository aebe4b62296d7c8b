#include "pointfront/Disk/FarSettings.h"

#include <gtest/gtest.h>

#include <string>

namespace pointfront
{
namespace
{
std::string refusal(const std::string& text)
{
  const Result<FarSettings> settings = FarSettings::parse(text);
  return settings ? "taken" : settings.error().what;
}
} // namespace

TEST(FarSettings, TravelInTheName)
{
  FarSettings settings;
  const std::string address = "https://host/a.pfront?sig=1";
  EXPECT_EQ(settings.named(address).value(), address);
  EXPECT_EQ(settings.named("a.pfront").value(), "a.pfront");
  settings.offline = true;
  settings.cacheFolder = "/a folder/100%&#";
  settings.cacheBytes = 4096;
  settings.timeoutSeconds = 0.25;
  const std::string named = settings.named(address).value();
  EXPECT_EQ(
    named, address + "#far:offline=1&cache=/a%20folder/100%25%26%23&cache_size=4096&timeout=0.25");
  EXPECT_EQ(withoutFarSettings(named), address);
  const Result<FarSettings> read = FarSettings::parse(farSettingsTextOf(named));
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(read->offline, true);
  EXPECT_EQ(read->cacheFolder, settings.cacheFolder);
  EXPECT_EQ(read->cacheBytes, 4096u);
  EXPECT_EQ(read->timeoutSeconds, 0.25);
  // Others replace them, and the epoch of a collection stays.
  FarSettings other;
  other.offline = false;
  EXPECT_EQ(other.named(named + "#epoch=2024").value(), address + "#far:offline=0#epoch=2024");
  EXPECT_EQ(farSettingsTextOf(address + "#far:offline=0#epoch=2024"), "offline=0");
  EXPECT_EQ(farSettingsTextOf(address), "");
}

TEST(FarSettings, SayWhatIsWrong)
{
  EXPECT_FALSE(FarSettings::parse("")->any());
  EXPECT_EQ(FarSettings::parse("cache_size=2m")->cacheBytes, 2u << 20);
  EXPECT_NE(refusal("offlin=1").find("'offlin=1' is no setting"), std::string::npos);
  EXPECT_NE(refusal("offline=yes").find("offline=0 or 1"), std::string::npos);
  EXPECT_NE(refusal("offline").find("offline=0 or 1"), std::string::npos);
  for (const char* time : { "timeout=0", "timeout=-1", "timeout=nan", "timeout=1s", "timeout=" })
  {
    EXPECT_NE(refusal(time).find("seconds above 0"), std::string::npos) << time;
  }
  for (const char* size : { "cache_size=-1", "cache_size=much", "cache_size=1Q", "cache_size=1Gi" })
  {
    EXPECT_NE(refusal(size).find("no size of a cache"), std::string::npos) << size;
  }
  EXPECT_NE(refusal("cache=").find("name is empty"), std::string::npos);
  EXPECT_NE(refusal("offline=1&cache=off").find("cache is off"), std::string::npos);
  EXPECT_NE(refusal("cache_size=0&offline=1").find("cache is off"), std::string::npos);
  FarSettings settings;
  settings.offline = true;
  const Result<std::string> path = settings.named("a.pfront");
  ASSERT_FALSE(path);
  EXPECT_NE(path.error().what.find("is a path"), std::string::npos);
  settings.timeoutSeconds = -1.0;
  EXPECT_FALSE(settings.named("https://host/a.pfront"));
}

} // namespace pointfront
