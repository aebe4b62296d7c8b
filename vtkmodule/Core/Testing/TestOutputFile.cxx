#include "SampleStore.h"

#include "pointfront/Store/DirectAppender.h"
#include "pointfront/Store/OutputFile.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
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
  std::ifstream in(path, std::ios::binary);
  const std::vector<char> chars{ std::istreambuf_iterator<char>(in), {} };
  std::vector<std::byte> bytes(chars.size());
  std::transform(chars.begin(), chars.end(), bytes.begin(),
    [](char c) { return static_cast<std::byte>(c); });
  return bytes;
}

/// Pieces of any size, on both sides of what is written at once; settled now and then.
void appendAndCompare(OutputFile::Durability durability)
{
  const std::vector<std::byte> all = pattern(3 * DirectAppender::bufferBytes + 12345);
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
      const std::vector<std::byte> settled = contentOf(path + ".tmp");
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
  EXPECT_FALSE(std::filesystem::exists(path + ".tmp"));
}

TEST(OutputFile, DurableBytesArriveWhateverTheirPieces)
{
  appendAndCompare(OutputFile::Durability::Full);
}

TEST(OutputFile, PassingBytesArriveWhateverTheirPieces)
{
  appendAndCompare(OutputFile::Durability::None);
}
} // namespace
} // namespace pointfront
