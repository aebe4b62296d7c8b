#include "FileBytes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <unistd.h>

namespace pointfront::test
{

FileBytes::FileBytes(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file) << path << " cannot be read";
  bytes_.assign(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
}

std::size_t FileBytes::find(const std::string& text) const
{
  const auto place = std::search(bytes_.begin(), bytes_.end(), text.begin(), text.end());
  EXPECT_NE(place, bytes_.end()) << "no \"" << text << "\"";
  return place == bytes_.end() ? 0 : static_cast<std::size_t>(place - bytes_.begin());
}

std::string FileBytes::write(const std::string& name) const
{
  const std::string path = outputFolder() + "/" + name;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(
    reinterpret_cast<const char*>(bytes_.data()), static_cast<std::streamsize>(bytes_.size()));
  EXPECT_TRUE(file.flush()) << path << " cannot be written";
  return path;
}

std::string outputFolder()
{
  const std::string folder = testing::TempDir() + "pointfront-las-" + std::to_string(::getpid());
  std::filesystem::create_directories(folder);
  return folder;
}

} // namespace pointfront::test
