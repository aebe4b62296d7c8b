#include "pointfront/InPlace/SideFile.h"

#include "pointfront/Codec/ByteStream.h"
#include "pointfront/Codec/Checksum.h"
#include "pointfront/Codec/SealedHeader.h"
#include "pointfront/InPlace/HeldAttributes.h"
#include "pointfront/InPlace/NodePoints.h"
#include "pointfront/Store/NodeTableSection.h"

#include <algorithm>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::size_t headerBytes = 64;
constexpr std::size_t rowBytes = 40;
/// Version of files without attributes of their own: programs that know no such read them.
constexpr std::uint32_t versionWithoutBlocks = 2;
constexpr unsigned largestLogStep = 40;
constexpr const char* again = "; index the file again: pointfront index --force";

struct Header
{
  std::uint32_t version = sideFileVersion;
  std::uint32_t requiredFeatures = 0;
  std::uint64_t fileBytes = 0;
  std::uint64_t tableOffset = 0;
  std::uint64_t tableBytes = 0;
  std::uint32_t tableChecksum = 0;
};

Error corrupt(const std::string& path, std::uint64_t offset, const std::string& what)
{
  return makeError(Error::Kind::Corrupt,
    "'" + path + "' is damaged: " + what + " (byte " + std::to_string(offset) + ")" + again);
}

std::vector<std::byte> encodeHeader(const Header& header)
{
  ByteWriter out;
  out.putBytes(sideFileMagic.data(), sideFileMagic.size());
  out.put(header.version);
  out.put(header.requiredFeatures);
  out.put(header.fileBytes);
  out.put(header.tableOffset);
  out.put(header.tableBytes);
  out.put(header.tableChecksum);
  return sealedHeader(std::move(out), headerBytes);
}

void putRow(ByteWriter& out, const InPlaceRow& row)
{
  out.put(row.offset);
  out.put(row.bytes);
  out.put(row.checksum);
  for (int axis = 0; axis < 3; ++axis)
  {
    out.put(static_cast<std::int32_t>(row.low[axis]));
  }
  out.put(row.pages);
  out.put(row.logStep);
  for (int reserved = 0; reserved < 7; ++reserved)
  {
    out.put(std::uint8_t(0));
  }
}

InPlaceRow getRow(ByteReader& in)
{
  InPlaceRow row;
  row.offset = in.get<std::uint64_t>();
  row.bytes = in.get<std::uint32_t>();
  row.checksum = in.get<std::uint32_t>();
  for (int axis = 0; axis < 3; ++axis)
  {
    row.low[axis] = in.get<std::int32_t>();
  }
  row.pages = in.get<std::uint32_t>();
  row.logStep = in.get<std::uint8_t>();
  std::uint8_t reserved[7];
  in.getBytes(reserved, sizeof reserved);
  return row;
}

std::vector<std::byte> encodeTable(const SideFileContent& content)
{
  ByteWriter out;
  const IndexedFile& file = content.indexed;
  out.putText(file.name);
  out.put(file.bytes);
  out.put(file.points);
  out.put(file.firstRecord);
  out.put(file.recordBytes);
  out.put(file.headerChecksum);
  out.put(file.edgesChecksum);
  out.put(content.leafPoints);
  out.put(content.table.leafRuns);
  const std::vector<std::byte> description = encodeDescription(content.stored, 1);
  out.put(static_cast<std::uint64_t>(description.size()));
  out.putBytes(description.data(), description.size());
  out.put(static_cast<std::uint32_t>(content.table.nodes.size()));
  const std::vector<std::byte> nodes =
    encodeNodeTable(content.table.nodes, NodeRowForm::WithSplatRadius);
  out.putBytes(nodes.data(), nodes.size());
  for (const InPlaceRow& row : content.table.rows)
  {
    putRow(out, row);
  }
  putHeldAttributes(out, content);
  return out.bytes();
}

std::string rowFault(const InPlaceTable& table, NodeIndex i, const SideFilePayload& payload)
{
  const InPlaceRow& row = table.rows[i];
  const bool inside = payload.holds(row.offset, row.bytes);
  const NodeIndex parent = table.nodes[i].parent;
  const bool stepsFall = row.logStep <= largestLogStep &&
    (table.nodes[i].leaf() ? row.logStep == 0
                           : parent == noNode || row.logStep <= table.rows[parent].logStep);
  return !inside ? "its list lies outside the file" : !stepsFall ? "its step is impossible" : "";
}

/// The fault of the table's bytes, or an empty text with `content` filled.
std::string tableFault(
  const std::byte* data, std::size_t size, const Header& header, SideFileContent& content)
{
  const SideFilePayload payload{ headerBytes, header.tableOffset };
  const NodeRowForm form = header.version < 2 ? NodeRowForm::Plain : NodeRowForm::WithSplatRadius;
  ByteReader in(data, size);
  IndexedFile& file = content.indexed;
  file.name = in.getText();
  file.bytes = in.get<std::uint64_t>();
  file.points = in.get<std::uint64_t>();
  file.firstRecord = in.get<std::uint64_t>();
  file.recordBytes = in.get<std::uint32_t>();
  file.headerChecksum = in.get<std::uint32_t>();
  file.edgesChecksum = in.get<std::uint32_t>();
  content.leafPoints = in.get<std::uint32_t>();
  content.table.leafRuns = in.get<std::uint64_t>();
  const auto described = in.get<std::uint64_t>();
  if (!in.ok() || described > in.remaining())
  {
    return "the table is cut off";
  }
  std::optional<StoredDescription> stored =
    decodeDescription(data + in.position(), static_cast<std::size_t>(described), 1);
  if (!stored || stored->description.layers.size() != 1)
  {
    return "the description contradicts itself";
  }
  content.stored = std::move(*stored);
  ByteReader rest(data + in.position() + described, in.remaining() - described);
  const std::uint64_t nodes = rest.get<std::uint32_t>();
  const std::uint64_t rowsBytes = nodes * (nodeRowBytes(form) + rowBytes);
  const bool blocks = header.version > versionWithoutBlocks;
  if (!rest.ok() || (blocks ? rest.remaining() < rowsBytes : rest.remaining() != rowsBytes))
  {
    return "the node table's size is wrong";
  }
  const std::byte* const rows = data + size - rest.remaining();
  content.table.nodes = decodeNodeTable(rows, static_cast<std::uint32_t>(nodes), form);
  std::string fault = nodeTableFault(content.table.nodes, 1, file.points);
  ByteReader inPlace(rows + nodes * nodeRowBytes(form), nodes * rowBytes);
  for (NodeIndex i = 0; i < nodes && fault.empty(); ++i)
  {
    content.table.rows.push_back(getRow(inPlace));
    const std::string row = rowFault(content.table, i, payload);
    fault = row.empty() ? "" : "node " + std::to_string(i) + ": " + row;
  }
  if (fault.empty() && blocks)
  {
    ByteReader further(rows + rowsBytes, rest.remaining() - rowsBytes);
    fault = heldAttributesFault(further, payload, content);
  }
  return fault;
}

Result<Header> readHeader(const ByteSource& file)
{
  std::byte bytes[headerBytes] = {};
  const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(file.bytes(), headerBytes));
  if (Result<void> done = file.readAt(0, bytes, size); !done)
  {
    return done.error();
  }
  if (size < sideFileMagic.size() ||
    std::memcmp(bytes, sideFileMagic.data(), sideFileMagic.size()) != 0)
  {
    return makeError(Error::Kind::BadFormat,
      "'" + file.path() + "' is not an index; indices are made with: pointfront index");
  }
  if (size < headerBytes)
  {
    return makeError(Error::Kind::Truncated,
      "'" + file.path() + "' has " + std::to_string(size) + " bytes, less than its header" + again);
  }
  ByteReader in(bytes + sideFileMagic.size(), headerBytes - sideFileMagic.size());
  Header header;
  header.version = in.get<std::uint32_t>();
  header.requiredFeatures = in.get<std::uint32_t>();
  header.fileBytes = in.get<std::uint64_t>();
  header.tableOffset = in.get<std::uint64_t>();
  header.tableBytes = in.get<std::uint64_t>();
  header.tableChecksum = in.get<std::uint32_t>();
  if (!headerIsSound(bytes, headerBytes))
  {
    return corrupt(file.path(), 0, "the header's checksum does not match");
  }
  return header;
}

Result<void> checkHeader(const Header& header, const ByteSource& file)
{
  const std::string& path = file.path();
  if (header.version == 0 || header.version > sideFileVersion || header.requiredFeatures != 0)
  {
    return makeError(Error::Kind::Unsupported,
      "'" + path + "' is an index of version " + std::to_string(header.version) + " (features " +
        std::to_string(header.requiredFeatures) + "), this program reads up to version " +
        std::to_string(sideFileVersion) + "; update PointFront, or index the file again");
  }
  if (file.bytes() < header.fileBytes)
  {
    return makeError(Error::Kind::Truncated,
      "'" + path + "' has " + std::to_string(file.bytes()) + " bytes of " +
        std::to_string(header.fileBytes) + again);
  }
  if (file.bytes() > header.fileBytes || header.tableOffset < headerBytes ||
    header.tableOffset > header.fileBytes ||
    header.tableBytes != header.fileBytes - header.tableOffset)
  {
    return corrupt(path, 16, "the table does not lie at the end of the file");
  }
  return {};
}
} // namespace

Result<std::unique_ptr<SideFileWriter>> SideFileWriter::create(const std::string& path)
{
  Result<std::unique_ptr<OutputFile>> file = OutputFile::create(path);
  if (!file)
  {
    return file.error();
  }
  std::unique_ptr<SideFileWriter> writer(new SideFileWriter(std::move(*file)));
  // Zeros until commit(): no part of a file that is not whole looks like an index.
  const std::vector<std::byte> header(headerBytes);
  if (Result<std::uint64_t> done = writer->append(header); !done)
  {
    return done.error();
  }
  return writer;
}

Result<std::uint64_t> SideFileWriter::append(const std::vector<std::byte>& bytes)
{
  const std::uint64_t offset = bytes_;
  if (Result<void> done = file_->append(bytes.data(), bytes.size()); !done)
  {
    return done.error();
  }
  bytes_ += bytes.size();
  return offset;
}

Result<void> SideFileWriter::commit(const SideFileContent& content)
{
  const std::vector<std::byte> table = encodeTable(content);
  Header header;
  header.version = content.held > 0 ? sideFileVersion : versionWithoutBlocks;
  header.tableOffset = bytes_;
  header.tableBytes = table.size();
  header.tableChecksum = checksumOf(table.data(), table.size());
  header.fileBytes = bytes_ + table.size();
  if (Result<std::uint64_t> done = append(table); !done)
  {
    return done.error();
  }
  const std::vector<std::byte> first = encodeHeader(header);
  if (Result<void> done = file_->overwrite(0, first.data(), first.size()); !done)
  {
    return done;
  }
  return file_->publish();
}

bool SideFile::looksLikeSideFile(const std::string& path)
{
  return beginsWith(path, sideFileMagic.data(), sideFileMagic.size());
}

Result<std::unique_ptr<const SideFile>> SideFile::open(const std::string& path)
{
  Result<std::shared_ptr<const ByteSource>> file = openBytes(path);
  if (!file)
  {
    return file.error();
  }
  const Result<Header> header = readHeader(**file);
  if (!header)
  {
    return header.error();
  }
  if (Result<void> sound = checkHeader(*header, **file); !sound)
  {
    return sound.error();
  }
  std::vector<std::byte> table(static_cast<std::size_t>(header->tableBytes));
  if (Result<void> done = (*file)->readAt(header->tableOffset, table.data(), table.size()); !done)
  {
    return done.error();
  }
  if (!matchesChecksum(table.data(), table.size(), header->tableChecksum))
  {
    return corrupt(path, header->tableOffset, "the table's checksum does not match");
  }
  std::unique_ptr<SideFile> side(new SideFile);
  const std::string fault = tableFault(table.data(), table.size(), *header, side->content_);
  if (!fault.empty())
  {
    return corrupt(path, header->tableOffset, fault);
  }
  side->content_.stored.description.version = header->version;
  side->file_ = std::move(*file);
  return std::unique_ptr<const SideFile>(std::move(side));
}

Result<std::vector<std::byte>> SideFile::readList(NodeIndex node) const
{
  const InPlaceRow& row = content_.table.rows[node];
  std::vector<std::byte> list(row.bytes);
  if (Result<void> done = file_->readAt(row.offset, list.data(), list.size()); !done)
  {
    return done.error();
  }
  if (!matchesChecksum(list.data(), list.size(), row.checksum))
  {
    return corrupt(file_->path(), row.offset,
      "node " + std::to_string(node) + ": the checksum of its runs does not match");
  }
  return list;
}

Result<std::vector<std::uint64_t>> SideFile::pointsOf(NodeIndex node) const
{
  const Result<std::vector<std::byte>> list = readList(node);
  if (!list)
  {
    return list.error();
  }
  std::optional<std::vector<std::uint64_t>> points =
    pointsOfList(content_.table, node, *list, content_.indexed.points);
  if (!points)
  {
    return corrupt(file_->path(), content_.table.rows[node].offset,
      "the runs of node " + std::to_string(node) + " do not give its " +
        std::to_string(content_.table.nodes[node].pointCount) + " points");
  }
  return std::move(*points);
}

Result<RawBytes> SideFile::blockOf(NodeIndex node, std::uint32_t held) const
{
  const ValueBlock& where = block(node, held);
  RawBytes coded(where.bytes);
  if (Result<void> done = file_->readAt(where.offset, coded.data.get(), coded.size); !done)
  {
    return done.error();
  }
  return coded;
}

Result<std::vector<std::byte>> SideFile::decodeBlock(
  NodeIndex node, std::uint32_t held, const RawBytes& coded) const
{
  const ValueBlock& where = block(node, held);
  const AttributeSchema& schema = content_.stored.description.schema;
  const Attribute& attribute = schema[schema.size() - content_.held + held];
  const BlockShape shape{ content_.table.nodes[node].pointCount, attribute.components,
    static_cast<unsigned>(sizeOf(attribute.type)) };
  std::vector<std::byte> values(shape.bytes());
  const bool whole = matchesChecksum(coded.data.get(), coded.size, where.checksum);
  if (!whole ||
    !pointfront::decodeBlock(where.codec, coded.data.get(), coded.size, shape, values.data()))
  {
    return corrupt(file_->path(), where.offset,
      "node " + std::to_string(node) + ", attribute '" + attribute.name + "': " +
        (whole ? "its values cannot be decoded" : "the checksum of its values does not match"));
  }
  return values;
}

} // namespace pointfront
