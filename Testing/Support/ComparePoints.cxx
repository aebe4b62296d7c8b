// usage: pointfrontComparePoints A.las B.las ATTRIBUTE...
//
// Are the points of two LAS or LAZ files the same multiset of (x, y, z, attributes), integer for
// integer, in whatever order? Reads both with our reader, sorts the records and compares them.
// Prints the number of points and exits with 0 if so; says what differs and exits with 1 if not.

#include "LASFormat.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

namespace
{

using namespace pointfront;

/// x, y, z as grid integers of 32 bit (as in LAS), then the bytes of the attributes.
constexpr std::size_t positionBytes = 12;
using Record = std::array<unsigned char, 32>;

struct PointTable
{
  QuantisationGrid grid;
  std::vector<Record> records;
};

[[noreturn]] void fail(const std::string& text)
{
  std::fprintf(stderr, "%s\n", text.c_str());
  std::exit(1);
}

std::vector<std::size_t> columnsOf(
  const SourceDescription& source, const std::vector<std::string>& attributes)
{
  std::vector<std::size_t> columns;
  std::size_t bytes = positionBytes;
  for (const std::string& name : attributes)
  {
    const std::optional<std::size_t> column = source.schema.find(name);
    if (!column)
    {
      fail(source.path + ": has no attribute " + name);
    }
    columns.push_back(*column);
    bytes += source.schema[*column].bytes();
  }
  if (bytes > sizeof(Record))
  {
    fail("too many attributes for one record");
  }
  return columns;
}

void appendBatch(const SourceDescription& source, const std::vector<std::size_t>& columns,
  const PointBatch& batch, PointTable& table)
{
  for (std::size_t i = 0; i < batch.size(); ++i)
  {
    Record record{};
    const GridPosition g = table.grid.toGrid(batch.positions[i]);
    const std::int32_t xyz[3] = { static_cast<std::int32_t>(g.x), static_cast<std::int32_t>(g.y),
      static_cast<std::int32_t>(g.z) };
    if (GridPosition(xyz[0], xyz[1], xyz[2]) != g)
    {
      fail(source.path + ": a coordinate is out of the 32 bit of LAS");
    }
    std::memcpy(record.data(), xyz, positionBytes);
    std::size_t at = positionBytes;
    for (const std::size_t column : columns)
    {
      const std::size_t bytes = source.schema[column].bytes();
      std::memcpy(record.data() + at, batch.columns[column].data() + i * bytes, bytes);
      at += bytes;
    }
    table.records.push_back(record);
  }
}

PointTable readSorted(const std::string& path, const std::vector<std::string>& attributes)
{
  Result<std::unique_ptr<PointSource>> source = LASFormat().open(path);
  if (!source)
  {
    fail(source.error().what);
  }
  const SourceDescription& description = (*source)->description();
  PointTable table;
  table.grid = description.grid.value();
  table.records.reserve(description.pointCount);
  const std::vector<std::size_t> columns = columnsOf(description, attributes);
  PointBatch batch;
  for (std::uint64_t chunk = 0; chunk < (*source)->chunkCount(); ++chunk)
  {
    if (Result<void> read = (*source)->read(chunk, batch); !read)
    {
      fail(read.error().what);
    }
    appendBatch(description, columns, batch, table);
  }
  std::sort(table.records.begin(), table.records.end());
  return table;
}

} // namespace

int main(int argc, char** argv)
{
  if (argc < 3)
  {
    fail("usage: pointfrontComparePoints A.las B.las ATTRIBUTE...");
  }
  const std::vector<std::string> attributes(argv + 3, argv + argc);
  const PointTable a = readSorted(argv[1], attributes);
  const PointTable b = readSorted(argv[2], attributes);
  if (!(a.grid == b.grid))
  {
    fail("the files have different scales or offsets");
  }
  if (a.records.size() != b.records.size())
  {
    fail(std::to_string(a.records.size()) + " points against " + std::to_string(b.records.size()));
  }
  const auto [at, other] =
    std::mismatch(a.records.begin(), a.records.end(), b.records.begin(), b.records.end());
  if (at != a.records.end())
  {
    std::int32_t xyz[2][3];
    std::memcpy(xyz[0], at->data(), positionBytes);
    std::memcpy(xyz[1], other->data(), positionBytes);
    fail("the sorted points differ at number " + std::to_string(at - a.records.begin()) + ": (" +
      std::to_string(xyz[0][0]) + ", " + std::to_string(xyz[0][1]) + ", " +
      std::to_string(xyz[0][2]) + ") against (" + std::to_string(xyz[1][0]) + ", " +
      std::to_string(xyz[1][1]) + ", " + std::to_string(xyz[1][2]) + ")");
  }
  std::printf("%zu\n", a.records.size());
  return 0;
}
