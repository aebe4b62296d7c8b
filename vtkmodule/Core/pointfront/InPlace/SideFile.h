#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Disk/ByteSource.h"
#include "pointfront/Disk/OutputFile.h"
#include "pointfront/InPlace/InPlaceTable.h"
#include "pointfront/InPlace/RunList.h"
#include "pointfront/Store/DescriptionSection.h"

#include <array>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// The newest that this program reads and writes; it writes 2 where no attribute is in the file.
constexpr std::uint32_t sideFileVersion = 3;
constexpr std::uint32_t mostHeldAttributes = 16;
constexpr std::array<unsigned char, 8> sideFileMagic{ 0x89, 'P', 'F', 'I', 'D', 'X', 0x0d, 0x0a };

/// The file that an index describes, with checksums that show whether it is still the same.
struct IndexedFile
{
  std::string name; ///< relative to the side file's folder
  std::uint64_t bytes = 0;
  std::uint64_t points = 0;
  std::uint64_t firstRecord = 0; ///< byte offset
  std::uint32_t recordBytes = 0;
  std::uint32_t headerChecksum = 0; ///< checksum of all bytes before the first record
  std::uint32_t edgesChecksum = 0; ///< checksum of the first and the last 64 KiB of the records
};

/// The content of a side file except its lists of runs.
struct SideFileContent
{
  IndexedFile indexed;
  StoredDescription stored; ///< path, sizes and counts are not set
  InPlaceTable table;
  std::uint32_t leafPoints = 0;
  /// So many attributes, the last of the description's, are those that the side file holds; the
  /// others are the indexed file's.
  std::uint32_t held = 0;
};

/// Writes a side file: lists of runs and blocks of values one after another, then all the rest.
/// Whole or absent.
/// Threads  one thread.
/// Errors   Unwritable.
class SideFileWriter
{
public:
  static Result<std::unique_ptr<SideFileWriter>> create(const std::string& path);

  /// Appends a node's list or block; gives its place.
  Result<std::uint64_t> append(const std::vector<std::byte>& bytes);
  Result<void> commit(const SideFileContent& content);
  std::uint64_t bytesWritten() const { return bytes_; }

private:
  explicit SideFileWriter(std::unique_ptr<OutputFile> file)
    : file_(std::move(file))
  {
  }
  std::unique_ptr<OutputFile> file_;
  std::uint64_t bytes_ = 0;
};

/// A side file, open for reading. The format: docs/formats/pfindex.md.
/// Threads  const functions are safe from any thread.
/// Errors   open: NotFound, Unreadable, BadFormat, Unsupported (a newer version), Truncated,
///          Corrupt.
class SideFile
{
public:
  static Result<std::unique_ptr<const SideFile>> open(const std::string& path);
  /// True if the file begins like a side file of any version. Cheap, silent.
  static bool looksLikeSideFile(const std::string& path);

  const SideFileContent& content() const { return content_; }
  std::uint64_t bytes() const { return file_->bytes(); }
  /// Numbers in the file of the points that a node holds, ascending.
  Result<std::vector<std::uint64_t>> pointsOf(NodeIndex node) const;
  /// The coded values of a node, of held attribute `held`.
  Result<RawBytes> blockOf(NodeIndex node, std::uint32_t held) const;
  /// Decodes them, in the order of pointsOf().
  Result<std::vector<std::byte>> decodeBlock(
    NodeIndex node, std::uint32_t held, const RawBytes& coded) const;
  std::uint32_t blockBytes(NodeIndex node, std::uint32_t held) const
  {
    return block(node, held).bytes;
  }

private:
  SideFile() = default;
  Result<std::vector<std::byte>> readList(NodeIndex node) const;
  const ValueBlock& block(NodeIndex node, std::uint32_t held) const
  {
    return content_.table.blocks[std::size_t(node) * content_.held + held];
  }

  std::shared_ptr<const ByteSource> file_;
  SideFileContent content_;
};

} // namespace pointfront
