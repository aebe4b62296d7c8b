#include "EPTRecords.h"

#include "pointfront/Disk/ByteOpeners.h"
#include "pointfront/Table/RecordNumbers.h"

#include <cstring>
#include <filesystem>
#include <utility>
#include <zstd.h>
#include <zstd_errors.h>

namespace pointfront
{

Result<std::vector<std::byte>> eptRecords(
  std::string_view file, EPTEncoding encoding, std::size_t expected, const std::string& path)
{
  std::vector<std::byte> records(expected);
  if (encoding == EPTEncoding::Binary)
  {
    if (file.size() != expected)
    {
      return makeError(Error::Kind::Truncated,
        path + ": has " + std::to_string(file.size()) + " bytes, its points " +
          std::to_string(expected) + "; get a whole copy");
    }
    std::memcpy(records.data(), file.data(), expected);
    return records;
  }
  const std::size_t size =
    ::ZSTD_decompress(records.data(), records.size(), file.data(), file.size());
  if (::ZSTD_getErrorCode(size) == ::ZSTD_error_memory_allocation)
  {
    return makeError(Error::Kind::NoMemory, path + ": there is no memory to unpack it");
  }
  if (::ZSTD_isError(size) != 0)
  {
    return makeError(
      Error::Kind::BadFormat, path + ": damaged zstandard data: " + ::ZSTD_getErrorName(size));
  }
  if (size != expected)
  {
    return makeError(Error::Kind::Truncated,
      path + ": unpacks to " + std::to_string(size) + " bytes, its points have " +
        std::to_string(expected) + "; get a whole copy");
  }
  return records;
}

/// Before hours of reading.
Result<void> EPTRecords::checkFiles() const
{
  const EPTDescription& description = tree_->description;
  if (isAddress(tree_->place))
  {
    return {}; // a round trip each: who reads a file finds out
  }
  for (const EPTNode& node : tree_->nodes)
  {
    const std::string file = tree_->fileOf(node);
    std::error_code failure;
    const std::uintmax_t bytes = std::filesystem::file_size(file, failure);
    if (failure)
    {
      return makeError(Error::Kind::NotFound, file + ": cannot be read, but the hierarchy has it");
    }
    const std::uintmax_t expected = node.points * description.recordBytes();
    if (description.encoding == EPTEncoding::Binary && bytes != expected)
    {
      return makeError(Error::Kind::Truncated,
        file + ": has " + std::to_string(bytes) + " bytes, its " + std::to_string(node.points) +
          " points " + std::to_string(expected) + "; get a whole copy");
    }
  }
  return {};
}

Result<std::unique_ptr<EPTRecords>> EPTRecords::open(std::shared_ptr<const EPTFolder> tree)
{
  const EPTDescription& description = tree->description;
  std::unique_ptr<EPTRecords> table(new EPTRecords);
  table->format_ = description.encoding == EPTEncoding::Binary ? "EPT binary" : "EPT zstandard";
  table->tree_ = tree;
  for (const EPTDimension& dimension : description.dimensions)
  {
    const bool world = dimension.scale != 1.0 || dimension.offset != 0.0;
    table->fields_.push_back({ dimension.name, world ? ScalarType::Float64 : dimension.type });
  }
  if (Result<void> there = table->checkFiles(); !there)
  {
    return there.error();
  }
  return table;
}

Result<void> EPTRecords::read(
  std::uint64_t chunk, const std::vector<bool>& wanted, TableBlock& block) const
{
  const EPTNode& node = tree_->nodes[static_cast<std::size_t>(chunk)];
  const Result<RawBytes> file = tree_->readNode(node);
  return file ? decode(node, *file, wanted, block) : Result<void>(file.error());
}

Result<void> EPTRecords::decode(const EPTNode& node, const RawBytes& file,
  const std::vector<bool>& wanted, TableBlock& block) const
{
  const std::size_t points = node.points;
  const EPTDescription& description = tree_->description;
  const std::string path = tree_->fileOf(node);
  const std::string_view bytes(reinterpret_cast<const char*>(file.data.get()), file.size);
  const std::size_t stride = description.recordBytes();
  const Result<std::vector<std::byte>> records =
    eptRecords(bytes, description.encoding, points * stride, path);
  if (!records)
  {
    return records.error();
  }
  block.resize(points, wanted);
  const std::byte* first = records->data();
  for (std::size_t d = 0; d < description.dimensions.size(); ++d)
  {
    const EPTDimension& dimension = description.dimensions[d];
    if (wanted[d])
    {
      std::vector<double>& column = block.columns[d];
      const RecordNumbers numbers{ first, stride, dimension.type, !machineIsLittleEndian() };
      gatherNumbers(numbers, column.size(), column.data());
      if (wantsWholes(dimension.type) && dimension.scale == 1.0 && dimension.offset == 0.0)
      {
        gatherWholes(numbers, column.size(), block.wholesOf(d).data());
      }
      for (double& value : column)
      {
        value = dimension.offset + dimension.scale * value;
      }
    }
    first += sizeOf(dimension.type);
  }
  return {};
}

} // namespace pointfront
