#include "CancelSignal.h"
#include "DrawnFiles.h"
#include "WholeFile.h"

#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <thread>

#include <sys/wait.h>
#include <unistd.h>

namespace pointfront
{

namespace
{
namespace fs = std::filesystem;

fs::path freshFolder(const char* name)
{
  const fs::path folder = fs::path(testing::TempDir()) / name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

std::size_t entries(const fs::path& folder)
{
  return static_cast<std::size_t>(
    std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}
} // namespace

TEST(WholeFile, ReplacesAndLeavesNothingElse)
{
  const fs::path folder = freshFolder("WholeFile.Replaces");
  const std::string path = (folder / "stats.json").string();
  ASSERT_TRUE(writeWholeFile(path, "one"));
  ASSERT_TRUE(writeWholeFile(path, "two"));
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  EXPECT_EQ(text.str(), "two");
  EXPECT_EQ(entries(folder), 1u);
}

TEST(WholeFile, SaysWhyItCannotBeWritten)
{
  const fs::path folder = freshFolder("WholeFile.SaysWhy");
  const auto missing = writeWholeFile((folder / "none" / "a.png").string(), "x");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().kind, Error::Kind::Unwritable);
  EXPECT_NE(missing.error().what.find("does not exist"), std::string::npos);

  const auto overFolder = writeWholeFile(folder.string(), "x");
  ASSERT_FALSE(overFolder);
  EXPECT_FALSE(checkWritable(folder.string()));
  EXPECT_FALSE(checkWritable((folder / "none" / "a.png").string()));
  EXPECT_TRUE(checkWritable((folder / "a.png").string()));
  EXPECT_EQ(entries(folder), 0u);
}

/// A command that draws tests its files before, and a signal ends it at once then.
TEST(WholeFile, ASignalLeavesNoFileOfTheTest)
{
  const fs::path folder = freshFolder("WholeFile.Signal");
  const std::string path = (folder / "a.png").string();
  for (int round = 0; round < 20; ++round)
  {
    const ::pid_t child = ::fork();
    if (child == 0)
    {
      const CancelSignal leaving(CancelSignal::Mode::Leave);
      while (checkDrawnFiles({ { path, FileKind::Picture } }, {}, {}))
      {
      }
      ::_exit(1);
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20 + round % 3));
    ::kill(child, SIGINT);
    int status = 0;
    ASSERT_EQ(::waitpid(child, &status, 0), child);
    ASSERT_EQ(entries(folder), 0u) << round;
  }
}

} // namespace pointfront
