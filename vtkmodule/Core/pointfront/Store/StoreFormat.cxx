#include "pointfront/Store/StoreFormat.h"

#include "pointfront/Codec/ByteStream.h"
#include "pointfront/Codec/Checksum.h"
#include "pointfront/Codec/SealedHeader.h"
#include "pointfront/Store/StoreAssembly.h"

#include <algorithm>
#include <utility>

namespace pointfront
{
namespace
{
/// A damaged store is built again, a damaged collection is made of its tiles.
std::string adviceOf(const std::string& path)
{
  return path.find(".pfcollection") == std::string::npos
    ? "copy the file again or build the store again"
    : "copy the file again or make it of its tiles: pointfront collection compact, or create where "
      "that cannot read the file";
}

constexpr std::size_t footerFixedBytes = 24;
constexpr std::size_t sectionEntryBytes = 24;
constexpr std::uint32_t maxSections = 64;
constexpr std::uint32_t firstVersionWithPieces = 4;

bool beginsLikeStore(const std::byte* data, std::size_t size)
{
  return std::memcmp(data, storeMagic.data(), std::min(size, storeMagic.size())) == 0;
}

std::string withName(SectionKind kind)
{
  switch (kind)
  {
    case SectionKind::Description:
      return "description";
    case SectionKind::NodeTable:
      return "node table";
    default:
      return "block directory";
  }
}

/// Text that is empty when the sections are where they may be, else what is wrong.
std::string sectionFault(const StoreFooter& footer, const StoreHeader& header)
{
  for (const SectionEntry& section : footer.sections)
  {
    const bool inside = section.offset >= storeHeaderBytes &&
      section.offset <= header.footerOffset &&
      section.bytes <= header.footerOffset - section.offset;
    if (!inside)
    {
      return "a section lies outside the file";
    }
  }
  for (SectionKind kind :
    { SectionKind::Description, SectionKind::NodeTable, SectionKind::BlockDirectory })
  {
    if (footer.find(kind) == nullptr)
    {
      return "the " + withName(kind) + " is missing";
    }
  }
  return {};
}
/// Checks a header with the right checksum: it may still have another version, another size.
Result<void> checkHeader(
  const StoreHeader& header, std::uint64_t fileBytes, const std::string& path)
{
  if (header.version == 0 || header.version > storeVersion)
  {
    return makeError(Error::Kind::Unsupported,
      "'" + path + "' is a store of version " + std::to_string(header.version) +
        ", this program reads up to version " + std::to_string(storeVersion) +
        "; update PointFront");
  }
  if ((header.requiredFeatures & ~(payloadElsewhere | headsOfCollection)) != 0)
  {
    return makeError(Error::Kind::Unsupported,
      "'" + path + "' uses features that this program does not know (flags " +
        std::to_string(header.requiredFeatures) + "); update PointFront");
  }
  if (fileBytes < header.fileBytes)
  {
    return makeError(Error::Kind::Truncated,
      "'" + path + "' has " + std::to_string(fileBytes) + " bytes of " +
        std::to_string(header.fileBytes) + "; " + adviceOf(path));
  }
  if (fileBytes > header.fileBytes)
  {
    return corruptStore(path, header.fileBytes,
      std::to_string(fileBytes - header.fileBytes) + " bytes follow the store's end");
  }
  const std::size_t mostPieces = header.version < firstVersionWithPieces ? 0 : maxColumns;
  if (header.footerOffset < storeHeaderBytes || header.footerOffset > header.fileBytes ||
    header.fileBytes - header.footerOffset != header.footerBytes ||
    header.footerBytes < footerFixedBytes + 4 ||
    header.footerBytes > footerFixedBytes + maxSections * sectionEntryBytes + mostPieces + 4)
  {
    return corruptStore(path, 24, "the footer does not lie at the end of the file");
  }
  return {};
}
} // namespace

const SectionEntry* StoreFooter::find(SectionKind kind) const
{
  const auto found = std::find_if(sections.begin(), sections.end(),
    [kind](const SectionEntry& section) { return section.kind == kind; });
  return found == sections.end() ? nullptr : &*found;
}

const MetadataRecord* collectionRecordIn(const std::vector<MetadataRecord>& metadata)
{
  const auto found = std::find_if(metadata.begin(), metadata.end(),
    [](const MetadataRecord& record)
    { return record.owner == collectionOwner && record.id == collectionId; });
  return found == metadata.end() ? nullptr : &*found;
}

Error corruptStore(const std::string& path, std::uint64_t offset, const std::string& what)
{
  return makeError(Error::Kind::Corrupt,
    "'" + path + "' is damaged: " + what + " (byte " + std::to_string(offset) + "); " +
      adviceOf(path));
}

std::vector<std::byte> encodeHeader(const StoreHeader& header)
{
  ByteWriter out;
  out.putBytes(storeMagic.data(), storeMagic.size());
  out.put(header.version);
  out.put(header.requiredFeatures);
  out.put(header.fileBytes);
  out.put(header.footerOffset);
  out.put(header.footerBytes);
  return sealedHeader(std::move(out), storeHeaderBytes);
}

std::vector<std::byte> encodeFooter(const StoreFooter& footer)
{
  ByteWriter out;
  out.put(footer.pointCount);
  out.put(footer.nodeCount);
  out.put(footer.columnCount);
  out.put(static_cast<std::uint32_t>(footer.sections.size()));
  out.put(std::uint32_t(0));
  for (const SectionEntry& section : footer.sections)
  {
    out.put(static_cast<std::uint32_t>(section.kind));
    out.put(section.checksum);
    out.put(section.offset);
    out.put(section.bytes);
  }
  out.putBytes(footer.pieces.data(), footer.pieces.size());
  out.put(checksumOf(out.bytes().data(), out.size()));
  return out.bytes();
}

Result<StoreHeader> decodeHeader(
  const std::byte* data, std::size_t size, std::uint64_t fileBytes, const std::string& path)
{
  if (!beginsLikeStore(data, size))
  {
    return makeError(Error::Kind::BadFormat,
      "'" + path + "' is not a PointFront store; stores are made with: pointfront build");
  }
  if (size < storeHeaderBytes)
  {
    return makeError(Error::Kind::Truncated,
      "'" + path + "' has " + std::to_string(size) + " bytes, less than a store's header of " +
        std::to_string(storeHeaderBytes) + "; " + adviceOf(path));
  }
  ByteReader in(data + storeMagic.size(), storeHeaderBytes - storeMagic.size());
  StoreHeader header;
  header.version = in.get<std::uint32_t>();
  header.requiredFeatures = in.get<std::uint32_t>();
  header.fileBytes = in.get<std::uint64_t>();
  header.footerOffset = in.get<std::uint64_t>();
  header.footerBytes = in.get<std::uint32_t>();
  if (!headerIsSound(data, storeHeaderBytes))
  {
    return corruptStore(path, 0, "the header's checksum does not match");
  }
  if (Result<void> sound = checkHeader(header, fileBytes, path); !sound)
  {
    return sound.error();
  }
  return header;
}

Result<StoreFooter> decodeFooter(
  const std::byte* data, const StoreHeader& header, const std::string& path)
{
  const std::size_t size = header.footerBytes;
  ByteReader end(data + size - 4, 4);
  if (!matchesChecksum(data, size - 4, end.get<std::uint32_t>()))
  {
    return corruptStore(path, header.footerOffset, "the footer's checksum does not match");
  }
  ByteReader in(data, size - 4);
  StoreFooter footer;
  footer.pointCount = in.get<std::uint64_t>();
  footer.nodeCount = in.get<std::uint32_t>();
  footer.columnCount = in.get<std::uint32_t>();
  const auto sections = in.get<std::uint32_t>();
  in.get<std::uint32_t>(); // reserved
  const std::uint64_t pieces = header.version < firstVersionWithPieces ? 0 : footer.columnCount;
  if (sections * std::uint64_t(sectionEntryBytes) + pieces != in.remaining())
  {
    return corruptStore(path, header.footerOffset, "the footer's size is wrong");
  }
  for (std::uint32_t i = 0; i < sections; ++i)
  {
    SectionEntry entry;
    entry.kind = static_cast<SectionKind>(in.get<std::uint32_t>());
    entry.checksum = in.get<std::uint32_t>();
    entry.offset = in.get<std::uint64_t>();
    entry.bytes = in.get<std::uint64_t>();
    footer.sections.push_back(entry);
  }
  footer.pieces.resize(static_cast<std::size_t>(pieces));
  in.getBytes(footer.pieces.data(), footer.pieces.size());
  const std::string fault = sectionFault(footer, header);
  if (!fault.empty())
  {
    return corruptStore(path, header.footerOffset, fault);
  }
  if (footer.columnCount > maxColumns)
  {
    return corruptStore(path, header.footerOffset, "the footer's column count is too large");
  }
  if (std::any_of(footer.pieces.begin(), footer.pieces.end(),
        [](std::uint8_t piece) { return piece >= payloadPieces; }))
  {
    return corruptStore(
      path, header.footerOffset, "the footer names a piece that payloads do not have");
  }
  return footer;
}

std::uint64_t payloadEndOf(const StoreFooter& footer)
{
  std::uint64_t end = UINT64_MAX;
  for (const SectionEntry& section : footer.sections)
  {
    end = std::min(end, section.offset);
  }
  return end;
}

Result<void> checkColumnCount(const AttributeSchema& schema)
{
  if (schema.size() > maxColumns)
  {
    return makeError(Error::Kind::BadArgument,
      "a store has at most " + std::to_string(maxColumns) + " attributes, not " +
        std::to_string(schema.size()) + "; name the ones to store");
  }
  return {};
}

} // namespace pointfront
