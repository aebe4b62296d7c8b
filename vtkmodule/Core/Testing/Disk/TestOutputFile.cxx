#include "FilesInTheMaking.h"
#include "SampleStore.h"

#include "pointfront/Disk/DirectAppender.h"
#include "pointfront/Disk/OutputFile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace pointfront
{
namespace
{
std::vector<std::byte> pattern(std::size_t size)
{
  std::vector<std::byte> bytes(size);
  std::uint32_t state = 1;
  for (std::byte& byte : bytes)
  {
    state = state * 1664525u + 1013904223u;
    byte = static_cast<std::byte>(state >> 24);
  }
  return bytes;
}

std::vector<std::byte> contentOf(const std::string& path)
{
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  std::vector<std::byte> bytes(in ? static_cast<std::size_t>(in.tellg()) : 0);
  in.seekg(0);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  EXPECT_TRUE(in) << path;
  return bytes;
}

/// Pieces of any size, on both sides of what is written at once; settled now and then.
void appendAndCompare(OutputFile::Durability durability)
{
  const std::vector<std::byte> all = pattern(7 * DirectAppender::bufferBytes + 12345);
  const std::string path = temporaryPath("out.bin");
  auto file = OutputFile::create(path, durability);
  ASSERT_TRUE(file) << file.error().what;
  const std::vector<std::size_t> sizes{ 1, 4095, 100000, DirectAppender::bufferBytes, 0, 77777,
    DirectAppender::bufferBytes - 1, 4096 };
  std::size_t at = 0;
  for (std::size_t piece = 0; at < all.size(); ++piece)
  {
    const std::size_t size = std::min(sizes[piece % sizes.size()], all.size() - at);
    ASSERT_TRUE((*file)->append(all.data() + at, size));
    at += size;
    if (piece % 3 == 0)
    {
      ASSERT_TRUE((*file)->settle());
      const std::vector<std::byte> settled = contentOf((*file)->pathMeanwhile());
      ASSERT_EQ(settled, std::vector<std::byte>(all.begin(), all.begin() + std::ptrdiff_t(at)));
    }
  }
  std::vector<std::byte> expected = all;
  const std::vector<std::byte> header(5000, std::byte(7));
  std::copy(header.begin(), header.end(), expected.begin());
  ASSERT_TRUE((*file)->overwrite(0, header.data(), header.size()));
  const std::vector<std::byte> more = pattern(10);
  ASSERT_TRUE((*file)->append(more.data(), more.size()));
  expected.insert(expected.end(), more.begin(), more.end());
  ASSERT_TRUE((*file)->publish());
  EXPECT_EQ(contentOf(path), expected);
  EXPECT_TRUE(filesInTheMaking(path).empty());
}

TEST(OutputFile, DurableBytesArriveWhateverTheirPieces)
{
  appendAndCompare(OutputFile::Durability::Full);
}

TEST(OutputFile, PassingBytesArriveWhateverTheirPieces)
{
  appendAndCompare(OutputFile::Durability::None);
}

/// Buffers are written while the next ones are gathered: the Error comes at the latest when all
/// must be there, and says where the disk ended.
TEST(OutputFile, ADiskThatEndsIsAnErrorAndLeavesNothing)
{
  const std::string path = temporaryPath("limited.bin");
  const pid_t child = fork();
  if (child == 0)
  {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{ 5000000, 5000000 };
    setrlimit(RLIMIT_FSIZE, &limit);
    auto file = OutputFile::create(path, OutputFile::Durability::Full);
    const std::vector<std::byte> piece = pattern(300000);
    Result<void> done;
    for (int i = 0; file && done && i < 50; ++i)
    {
      done = (*file)->append(piece.data(), piece.size());
    }
    done = done ? (*file)->publish() : done;
    const bool told = !done && done.error().kind == Error::Kind::Unwritable &&
      done.error().what.find("after byte 5000000;") != std::string::npos;
    file = makeError(Error::Kind::Cancelled, "closed");
    _exit(told ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_TRUE(filesInTheMaking(path).empty());
}

/// A file that is given up while the disk works.
TEST(OutputFile, IsGoneWhenItIsGivenUp)
{
  const std::string path = temporaryPath("given-up.bin");
  {
    auto file = OutputFile::create(path, OutputFile::Durability::Full);
    ASSERT_TRUE(file);
    const std::vector<std::byte> bytes = pattern(2 * DirectAppender::bufferBytes + 1);
    ASSERT_TRUE((*file)->append(bytes.data(), bytes.size()));
  }
  EXPECT_FALSE(std::filesystem::exists(path));
  EXPECT_TRUE(filesInTheMaking(path).empty());
}
} // namespace
} // namespace pointfront
