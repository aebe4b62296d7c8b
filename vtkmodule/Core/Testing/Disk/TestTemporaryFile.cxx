#include "FilesInTheMaking.h"
#include "SampleStore.h"

#include "pointfront/Disk/OutputFile.h"
#include "pointfront/Disk/TemporaryFile.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <sys/wait.h>
#include <unistd.h>

namespace pointfront
{
namespace
{
namespace fs = std::filesystem;

const std::vector<std::byte> mine(3, std::byte(7));

/// Publishes nothing but an empty file.
Result<void> publish(Result<std::unique_ptr<OutputFile>>& file)
{
  return (*file)->publish();
}
} // namespace

TEST(TemporaryFile, WhatAppearsMeanwhileIsKept)
{
  const std::string path = temporaryPath("a.bin");
  {
    auto file = OutputFile::create(path);
    ASSERT_TRUE(file);
    writeFile(path, mine);
    const Result<void> done = publish(file);
    ASSERT_FALSE(done);
    EXPECT_EQ(done.error().kind, Error::Kind::Unwritable);
    EXPECT_NE(done.error().what.find(path), std::string::npos);
  }
  EXPECT_EQ(fileBytes(path), mine);
  EXPECT_TRUE(filesInTheMaking(path).empty());
}

TEST(TemporaryFile, WhatWasThereIsReplaced)
{
  const std::string path = temporaryPath("a.bin");
  writeFile(path, mine);
  auto file = OutputFile::create(path);
  ASSERT_TRUE(file);
  ASSERT_TRUE(publish(file));
  EXPECT_EQ(fs::file_size(path), 0u);
}

TEST(TemporaryFile, ALinkToNothingIsReplaced)
{
  const std::string path = temporaryPath("a.bin");
  fs::create_symlink(temporaryPath("nothing"), path);
  auto file = OutputFile::create(path);
  ASSERT_TRUE(file);
  const Result<void> done = publish(file);
  ASSERT_TRUE(done) << done.error().what;
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(path)));
}

TEST(TemporaryFile, OneProcessAtATime)
{
  const std::string path = temporaryPath("a.bin");
  auto first = OutputFile::create(path);
  ASSERT_TRUE(first);
  const auto second = OutputFile::create(path);
  ASSERT_FALSE(second);
  EXPECT_EQ(filesInTheMaking(path), std::vector<std::string>{ (*first)->pathMeanwhile() });
  EXPECT_FALSE(removeLeftOvers(path));
  EXPECT_TRUE(OutputFile::create(path + "2")); // another file
  ASSERT_TRUE(publish(first));
  EXPECT_TRUE(OutputFile::create(path));
}

TEST(TemporaryFile, OfADeadProcessGoesWithTheNext)
{
  const std::string path = temporaryPath("a.bin");
  const pid_t child = fork();
  if (child == 0)
  {
    auto file = OutputFile::create(path);
    _exit(file ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == 0);
  const std::vector<std::string> left = filesInTheMaking(path);
  ASSERT_EQ(left.size(), 1u);
  // A copy has another inode: it is somebody's own file.
  const std::string copy = left[0].substr(0, left[0].size() - 5) + "0.tmp";
  writeFile(copy == left[0] ? copy.substr(0, copy.size() - 5) + "1.tmp" : copy, mine);
  EXPECT_TRUE(removeLeftOvers(path));
  const std::vector<std::string> kept = filesInTheMaking(path);
  ASSERT_EQ(kept.size(), 1u);
  EXPECT_EQ(fileBytes(kept[0]), mine);
}

TEST(TemporaryFile, LinksAreNotFollowed)
{
  const std::string path = temporaryPath("a.bin"), other = temporaryPath("other");
  writeFile(other, mine);
  fs::create_symlink(other, path + ".tmp");
  auto file = OutputFile::create(path);
  ASSERT_TRUE(file);
  ASSERT_TRUE(publish(file));
  EXPECT_EQ(fileBytes(other), mine);
}

} // namespace pointfront
