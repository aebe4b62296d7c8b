#pragma once

#include "pointfront/Points/PointSource.h"

#include <cstdio>
#include <cstdlib>
#include <memory>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

namespace pointfront::fuzz
{

/// Bytes that have a path and never touch a disk.
class BytesAsFile
{
public:
  BytesAsFile(const std::uint8_t* data, std::size_t size)
    : descriptor_(::memfd_create("fuzz", MFD_CLOEXEC))
  {
    if (descriptor_ < 0 || ::write(descriptor_, data, size) != static_cast<ssize_t>(size))
    {
      std::perror("memfd_create");
      std::abort();
    }
  }
  ~BytesAsFile() { ::close(descriptor_); }
  BytesAsFile(const BytesAsFile&) = delete;
  BytesAsFile& operator=(const BytesAsFile&) = delete;

  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }

private:
  int descriptor_;
};

/// Stops the fuzzer: a promise of the interface was broken.
inline void require(bool held, const char* promise)
{
  if (!held)
  {
    std::fprintf(stderr, "broken promise: %s\n", promise);
    std::abort();
  }
}

/// Opens the bytes as that format and reads every point: an Error with words, or the points that
/// were announced.
inline void readAsPoints(
  const PointSourceFormat& format, const std::uint8_t* data, std::size_t size)
{
  const BytesAsFile file(data, size);
  format.accepts(file.path());
  const Result<std::unique_ptr<PointSource>> source = format.open(file.path());
  if (!source)
  {
    require(!source.error().what.empty(), "an Error says what happened");
    return;
  }
  const PointSource& points = **source;
  const AttributeSchema& schema = points.description().schema;
  std::uint64_t count = 0;
  PointBatch batch;
  for (std::uint64_t chunk = 0; chunk < points.chunkCount(); ++chunk)
  {
    count += points.chunkPoints(chunk);
    if (const Result<void> read = points.read(chunk, batch); !read)
    {
      require(!read.error().what.empty(), "an Error says what happened");
      continue;
    }
    require(batch.size() == points.chunkPoints(chunk), "a chunk holds what it announced");
    require(batch.columns.size() == schema.size(), "there is a column for each attribute");
    for (std::size_t c = 0; c < schema.size(); ++c)
    {
      require(batch.columns[c].size() == batch.size() * schema[c].bytes(), "columns are full");
    }
  }
  require(count == points.description().pointCount, "the chunks hold all points");
}

} // namespace pointfront::fuzz
