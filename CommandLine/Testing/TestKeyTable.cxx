#include "FactsText.h"
#include "FreshName.h"
#include "KeyTable.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

namespace pointfront
{

TEST(KeyTable, EachKeyDoesOneThingAndIsInTheHelp)
{
  std::set<std::string> keys;
  const std::string help = keyHelp();
  for (const KeyBinding& binding : keyTable)
  {
    EXPECT_TRUE(keys.insert(binding.key).second) << binding.key;
    EXPECT_EQ(keyActionOf(binding.key), binding.action) << binding.key;
    EXPECT_NE(binding.action, KeyAction::None);
    EXPECT_NE(help.find(binding.what), std::string::npos);
  }
  EXPECT_EQ(keyActionOf("question"), KeyAction::Help);
  EXPECT_EQ(keyActionOf("Shift_L"), KeyAction::None);
}

TEST(FreshName, NamesWhatIsNotThere)
{
  namespace fs = std::filesystem;
  const std::string stem = testing::TempDir() + "fresh";
  for (int i = 1; i < 5; ++i)
  {
    fs::remove(stem + "-" + std::to_string(i) + ".png");
  }
  EXPECT_EQ(freshName(stem, ".png"), stem + "-1.png");
  std::ofstream(stem + "-1.png") << "x";
  fs::create_symlink("nothing", stem + "-2.png"); // its target may come back
  EXPECT_EQ(freshName(stem, ".png"), stem + "-3.png");
}

TEST(FactsText, SaysWhatAFrameWas)
{
  EXPECT_EQ(grouped(0), "0");
  EXPECT_EQ(grouped(999), "999");
  EXPECT_EQ(grouped(1234567), "1,234,567");
  EXPECT_EQ(grouped(-1000), "-1,000");
  FrameRecord frame;
  frame.milliseconds = 20.0;
  frame.points = 4321;
  frame.errorPx = 1.25;
  EXPECT_EQ(
    factsText(frame, true), "20 ms a frame, 50 a second\n4,321 points, error 1.2 px, loading");
  frame.complete = true;
  EXPECT_NE(factsText(frame, false).find("complete"), std::string::npos);
}

} // namespace pointfront
