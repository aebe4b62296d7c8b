#pragma once

#include "pointfront/Points/PointSource.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <unistd.h>
#include <vector>

/// Helpers that tests of point sources share.
namespace pointfront::test
{

/// All points of a source in the order of their chunks. A chunk that cannot be read, or that gives
/// another number of points than it announced, is a test failure.
inline PointBatch readPoints(const PointSource& source)
{
  PointBatch all;
  PointBatch chunk;
  all.resize(0, source.description().schema);
  for (std::uint64_t i = 0; i < source.chunkCount(); ++i)
  {
    const Result<void> done = source.read(i, chunk);
    EXPECT_TRUE(done.ok());
    EXPECT_EQ(chunk.size(), source.chunkPoints(i));
    all.append(chunk);
  }
  EXPECT_EQ(all.size(), source.description().pointCount);
  return all;
}

/// Opens with that format; a failure is a test failure and gives nullptr.
inline std::unique_ptr<PointSource> openPoints(
  const PointSourceFormat& format, const std::string& path)
{
  Result<std::unique_ptr<PointSource>> source = format.open(path);
  EXPECT_TRUE(source.ok()) << source.error().what;
  return source ? std::move(*source) : nullptr;
}

/// Column of that name; it must be of type T with that many components.
template <typename T>
std::vector<T> columnOf(const PointSource& source, const PointBatch& batch, const char* name)
{
  const AttributeSchema& schema = source.description().schema;
  const auto column = schema.find(name);
  EXPECT_TRUE(column) << "no attribute " << name;
  if (!column || sizeOf(schema[*column].type) != sizeof(T))
  {
    ADD_FAILURE() << name << " has another type";
    return {};
  }
  const std::vector<std::byte>& bytes = batch.columns[*column];
  std::vector<T> values(bytes.size() / sizeof(T));
  if (!bytes.empty()) // memcpy takes no null pointers, not even for nothing
  {
    std::memcpy(values.data(), bytes.data(), bytes.size());
  }
  return values;
}

/// "name type components" of every attribute, separated by ", ".
inline std::string schemaText(const PointSource& source)
{
  std::string text;
  for (const Attribute& attribute : source.description().schema)
  {
    text += (text.empty() ? "" : ", ") + attribute.name + " " + std::string(nameOf(attribute.type));
    text += attribute.components > 1 ? "x" + std::to_string(attribute.components) : "";
  }
  return text;
}

inline std::string bytesOfFile(const std::string& path)
{
  std::ifstream file(path, std::ios::binary);
  EXPECT_TRUE(file.good()) << path << " cannot be read";
  return { std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>() };
}

/// Writes a file under a folder of this process; gives its path.
inline std::string writeFile(const std::string& name, const std::string& bytes)
{
  const std::string folder = testing::TempDir() + "pointfront-points-" + std::to_string(::getpid());
  std::filesystem::create_directories(folder);
  const std::string path = folder + "/" + name;
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  EXPECT_TRUE(file.flush().good()) << path << " cannot be written";
  return path;
}

/// Opens and reads every beginning of `bytes`, down to none: each is an Error or gives exactly the
/// points it announces.
inline void expectSoundCutAnywhere(
  const PointSourceFormat& format, const std::string& bytes, const std::string& name)
{
  for (std::size_t size = 0; size < bytes.size(); ++size)
  {
    Result<std::unique_ptr<PointSource>> source =
      format.open(writeFile(name, bytes.substr(0, size)));
    if (!source)
    {
      EXPECT_FALSE(source.error().what.empty());
      continue;
    }
    SCOPED_TRACE("cut to " + std::to_string(size));
    readPoints(**source);
  }
}

} // namespace pointfront::test
