#include "InputFiles.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace pointfront
{

namespace
{
namespace fs = std::filesystem;

/// folder/{b.las, a.LAZ, notes.txt, deeper/c.las}
class InputFiles : public testing::Test
{
protected:
  void SetUp() override
  {
    const testing::TestInfo* test = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = fs::path(testing::TempDir()) / (std::string("InputFiles.") + test->name());
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "deeper");
    for (const char* name : { "b.las", "a.LAZ", "notes.txt", "deeper/c.las" })
    {
      std::ofstream(folder_ / name) << name;
    }
  }
  void TearDown() override { fs::remove_all(folder_); }

  std::string at(const std::string& name) const { return (folder_ / name).string(); }

  fs::path folder_;
  const std::vector<std::string> extensions_ = { "las", "laz" };
};
} // namespace

TEST_F(InputFiles, FolderGivesItsPointFilesSorted)
{
  const auto list = findInputFiles({ folder_.string() }, extensions_);
  ASSERT_TRUE(list) << list.error().what;
  EXPECT_EQ(
    list.value().paths, (std::vector<std::string>{ at("a.LAZ"), at("b.las"), at("deeper/c.las") }));
  EXPECT_TRUE(list.value().warnings.empty());
}

TEST_F(InputFiles, OrderOfArgumentsDoesNotMatter)
{
  const auto one = findInputFiles({ at("b.las"), at("a.LAZ") }, extensions_);
  const auto other = findInputFiles({ at("a.LAZ"), at("b.las") }, extensions_);
  ASSERT_TRUE(one && other);
  EXPECT_EQ(one.value().paths, other.value().paths);
}

TEST_F(InputFiles, PatternIsExpanded)
{
  const auto list = findInputFiles({ at("*.las"), at("[a]*") }, extensions_);
  ASSERT_TRUE(list) << list.error().what;
  EXPECT_EQ(list.value().paths, (std::vector<std::string>{ at("a.LAZ"), at("b.las") }));
}

TEST_F(InputFiles, SameFileTwiceIsReadOnceWithAWarning)
{
  const auto list = findInputFiles({ at("b.las"), at("deeper/../b.las") }, extensions_);
  ASSERT_TRUE(list) << list.error().what;
  EXPECT_EQ(list.value().paths.size(), 1u);
  ASSERT_EQ(list.value().warnings.size(), 1u);
  EXPECT_NE(list.value().warnings[0].find("b.las"), std::string::npos);
}

TEST_F(InputFiles, LinksToAFileAreTheSameFile)
{
  fs::create_hard_link(at("b.las"), at("hard.las"));
  fs::create_symlink(at("b.las"), at("soft.las"));
  const auto list = findInputFiles({ folder_.string(), at("hard.las") }, extensions_);
  ASSERT_TRUE(list) << list.error().what;
  EXPECT_EQ(
    list->paths, (std::vector<std::string>{ at("a.LAZ"), at("b.las"), at("deeper/c.las") }));
  EXPECT_EQ(list->warnings,
    (std::vector<std::string>{
      at("hard.las") + " is the same file as " + at("b.las") + ": read once",
      at("hard.las") + " is the same file as " + at("b.las") + ": read once",
      at("soft.las") + " is the same file as " + at("b.las") + ": read once" }));
}

TEST_F(InputFiles, NamedFileIsTakenWhateverItsExtension)
{
  const auto list = findInputFiles({ at("notes.txt") }, extensions_);
  ASSERT_TRUE(list);
  EXPECT_EQ(list.value().paths, std::vector<std::string>{ at("notes.txt") });
}

TEST_F(InputFiles, NothingFoundIsAnErrorThatNamesTheArgument)
{
  fs::create_directories(folder_ / "empty");
  for (const char* argument : { "none.las", "*.ply", "empty" })
  {
    const auto list = findInputFiles({ at(argument) }, extensions_);
    ASSERT_FALSE(list) << argument;
    EXPECT_EQ(list.error().kind, Error::Kind::NotFound);
    EXPECT_NE(list.error().what.find(at(argument)), std::string::npos);
  }
}

TEST_F(InputFiles, AllThatAreNotFoundAreNamed)
{
  const auto none = findInputFiles({ at("none.las"), at("b.las"), at("*.ply") }, extensions_);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().what.find("2 of 3 inputs"), std::string::npos) << none.error().what;
  EXPECT_NE(none.error().what.find(at("none.las")), std::string::npos);
  EXPECT_NE(none.error().what.find(at("*.ply")), std::string::npos);
  std::vector<InputFault> faults;
  const auto some =
    findInputFiles({ at("none.las"), at("b.las"), at("*.ply") }, extensions_, {}, &faults);
  ASSERT_TRUE(some);
  EXPECT_EQ(some->paths, std::vector<std::string>{ at("b.las") });
  ASSERT_EQ(faults.size(), 2u);
  EXPECT_EQ(faults[0].path, at("none.las"));
  EXPECT_EQ(faults[0].why, "no such file or folder");
}

} // namespace pointfront
