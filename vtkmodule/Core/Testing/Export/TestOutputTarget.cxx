#include "pointfront/Export/OutputTarget.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include <unistd.h>

namespace pointfront
{
namespace
{
namespace fs = std::filesystem;

class OutputTargetTest : public testing::Test
{
protected:
  void SetUp() override
  {
    folder = fs::path(testing::TempDir()) / ("pointfront-target-" + std::to_string(getpid()));
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }

  std::string file(const std::string& name, const std::string& bytes) const
  {
    std::ofstream(folder / name, std::ios::binary) << bytes;
    return (folder / name).string();
  }
  static std::string refusal(const OutputTarget& target, const std::vector<std::string>& reads = {})
  {
    const Result<void> checked = checkOutputTarget(target, reads);
    return checked ? "" : checked.error().what;
  }

  fs::path folder;
};

TEST_F(OutputTargetTest, ANewNameAndAFileOfNoBytesAreFree)
{
  EXPECT_EQ(refusal({ (folder / "new").string(), FileKind::LAS }), "");
  const std::string empty = file("empty", "");
  EXPECT_NE(refusal({ empty, FileKind::LAS }).find("exists already"), std::string::npos);
  EXPECT_EQ(refusal({ empty, FileKind::LAS, true }), "");
}

TEST_F(OutputTargetTest, ANameSaysItsKindInLargeLettersToo)
{
  const auto named = [&](const char* name) { return (folder / name).string(); };
  EXPECT_NE(refusal({ named("B.LAS"), FileKind::Store }).find("is named as"), std::string::npos);
  EXPECT_NE(refusal({ named("B.Copc.Laz"), FileKind::LAS }).find("as COPC"), std::string::npos);
  EXPECT_EQ(refusal({ named("B.COPC.LAZ"), FileKind::COPC }), "");
  EXPECT_EQ(refusal({ named("B.PFRONT"), FileKind::Store }), "");
}

TEST_F(OutputTargetTest, EveryKindIsReplacedByItselfOnly)
{
  using namespace std::string_literals;
  const std::vector<std::pair<FileKind, std::string>> files = {
    { FileKind::Store, "\x89PFRONT\n and more" },
    { FileKind::SideFile, "\x89PFIDX\r\n and more" },
    { FileKind::LAS, "LASF\0\0"s },
    { FileKind::PLY, "ply\nformat ascii 1.0\n" },
    { FileKind::PCD, "# .PCD v0.7\nVERSION 0.7\n" },
    { FileKind::Text, "# x y z\n1 2 3\n" },
    { FileKind::Picture, "\x89PNG\r\n\x1a\n\0"s },
    { FileKind::Statistics, "{\n  \"complete\": true, \"points_drawn\": 5 }" },
    { FileKind::FrameTable, "frame,ms,points\n0,1,2\n" },
  };
  for (const auto& [there, bytes] : files)
  {
    const std::string path = file("x", bytes);
    for (const auto& [kind, unused] : files)
    {
      const std::string said = refusal({ path, kind, true });
      EXPECT_EQ(said.empty(), kind == there) << int(there) << " by " << int(kind) << ": " << said;
      EXPECT_FALSE(refusal({ path, kind, false }).empty());
    }
  }
  const std::string other = file("x", "{\"position\": [0, 0, 1]}");
  EXPECT_FALSE(refusal({ other, FileKind::Statistics, true }).empty());
  EXPECT_FALSE(refusal({ folder.string(), FileKind::Text, true }).empty());
  EXPECT_FALSE(refusal({ "/dev/null", FileKind::Text, true }).empty());
}

TEST_F(OutputTargetTest, WhatIsReadIsKeptByEveryName)
{
  const std::string input = file("input", "LASF");
  fs::create_hard_link(input, folder / "hard");
  fs::create_symlink(input, folder / "soft");
  for (const char* name : { "input", "hard", "soft", "./input" })
  {
    const std::string said = refusal({ (folder / name).string(), FileKind::LAS, true }, { input });
    EXPECT_NE(said.find("which is read"), std::string::npos) << name << ": " << said;
  }
  const std::string other = file("out.tmp", "LASF"); // a name like that of any other file
  EXPECT_TRUE(refusal({ (folder / "out").string(), FileKind::LAS }, { other }).empty());
  EXPECT_TRUE(sameFile(input, (folder / "hard").string()));
  EXPECT_FALSE(sameFile(input, other));
  EXPECT_FALSE(sameFile("no/such", "no/such"));
}
} // namespace
} // namespace pointfront
