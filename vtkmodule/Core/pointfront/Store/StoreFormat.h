#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Payload/ColumnPieces.h"
#include "pointfront/Points/PointSource.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

// The frame of a store file: header, payload, sections, footer. docs/formats/pfront.md has every
// byte; what stands here must agree with it.

constexpr std::uint32_t storeVersion = 4; ///< written by this program, and the newest it reads
constexpr std::size_t storeHeaderBytes = 64;
constexpr std::array<unsigned char, 8> storeMagic{ 0x89, 'P', 'F', 'R', 'O', 'N', 'T', 0x0a };

/// More points than a sane node has; a table that claims more is refused before memory is taken.
constexpr std::uint32_t maxNodePoints = 1u << 24;
/// Columns of a schema, a limit of the format.
constexpr std::uint32_t maxColumns = 4096;

enum class SectionKind : std::uint32_t
{
  Description = 1,
  NodeTable = 2,
  BlockDirectory = 3,
  Elsewhere = 4, ///< only with payloadElsewhere
  NodeRanges = 5 ///< may be missing: nobody knows then which nodes a filter leaves out
};

/// Required feature: the payload of some nodes lies in another file (see NodePayload::elsewhere).
/// Previews of a build have it: they name the store being written.
constexpr std::uint32_t payloadElsewhere = 1;
/// Required feature: the points are only the heads of a collection's tiles, which a metadata record
/// names (Tiles/CollectionRecord.h). Who reads stores alone must not take them for all.
constexpr std::uint32_t headsOfCollection = 2;

/// Where a section lies and what it must hash to (since version 2 only the description and the name
/// of another file: the others are read in parts, which have checksums of their own, and 0 stands
/// here).
struct SectionEntry
{
  SectionKind kind = SectionKind::Description;
  std::uint32_t checksum = 0;
  std::uint64_t offset = 0;
  std::uint64_t bytes = 0;
};

/// The first 64 bytes. Their layout is the same in all versions for ever, so that any program can
/// tell a newer store from a damaged one.
struct StoreHeader
{
  std::uint32_t version = storeVersion;
  std::uint32_t requiredFeatures = 0; ///< bits a reader must know: those above
  std::uint64_t fileBytes = 0;
  std::uint64_t footerOffset = 0;
  std::uint32_t footerBytes = 0;
};

/// The last bytes of the file.
struct StoreFooter
{
  std::uint64_t pointCount = 0;
  std::uint32_t nodeCount = 0;
  std::uint32_t columnCount = 0;
  std::vector<SectionEntry> sections;
  ColumnPieces pieces; ///< since version 4, one for each column; empty before: all in the first

  const SectionEntry* find(SectionKind kind) const;
};

std::vector<std::byte> encodeHeader(const StoreHeader& header);
std::vector<std::byte> encodeFooter(const StoreFooter& footer);

/// `path` is for messages only. Errors: Truncated, BadFormat (not a store), Corrupt, Unsupported.
Result<StoreHeader> decodeHeader(
  const std::byte* data, std::size_t size, std::uint64_t fileBytes, const std::string& path);
/// Also checks that the sections that a store needs are there and lie between header and footer.
Result<StoreFooter> decodeFooter(
  const std::byte* data, const StoreHeader& header, const std::string& path);

/// Payloads lie between the header and the first section.
std::uint64_t payloadEndOf(const StoreFooter& footer);

/// The metadata record that names the tiles of a collection; null: there is none.
constexpr const char* collectionOwner = "pointfront";
constexpr std::uint16_t collectionId = 2;
const MetadataRecord* collectionRecordIn(const std::vector<MetadataRecord>& metadata);

/// "'x.pfront' is damaged: <what> (byte <offset>); <advice>".
Error corruptStore(const std::string& path, std::uint64_t offset, const std::string& what);

} // namespace pointfront
