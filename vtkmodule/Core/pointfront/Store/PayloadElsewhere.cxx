#include "pointfront/Store/PayloadElsewhere.h"

#include "pointfront/Codec/ByteStream.h"
#include "pointfront/Codec/Checksum.h"
#include "pointfront/Disk/ByteOpeners.h"

namespace pointfront
{
namespace
{
bool holds(const ByteSource& file, const PayloadElsewhere& elsewhere)
{
  const BlockDirectory::Block& mark = elsewhere.mark;
  if (file.bytes() < elsewhere.bytes || mark.offset > elsewhere.bytes ||
    mark.bytes > elsewhere.bytes - mark.offset)
  {
    return false;
  }
  std::vector<std::byte> bytes(mark.bytes);
  return file.readAt(mark.offset, bytes.data(), bytes.size()) &&
    matchesChecksum(bytes.data(), bytes.size(), mark.checksum);
}

/// Whether it names a file in the same folder.
bool isPlainName(const std::string& name)
{
  return !name.empty() && name.find('/') == std::string::npos &&
    name.find('\0') == std::string::npos;
}
} // namespace

PayloadElsewhere describeElsewhere(PayloadElsewhere elsewhere, const BlockDirectory& directory)
{
  elsewhere.mark.checksum = checksumOf(nullptr, 0);
  for (std::uint32_t node = 0; node < directory.nodeCount(); ++node)
  {
    if (directory.isElsewhere(node, 0) && directory.pieceBytes(node, 0) > 0 &&
      directory.offset(node, 0) > elsewhere.mark.offset)
    {
      elsewhere.mark = directory.block(node, 0);
    }
  }
  return elsewhere;
}

std::vector<std::byte> encodeElsewhere(const PayloadElsewhere& elsewhere)
{
  ByteWriter out;
  out.put(elsewhere.bytes);
  out.put(elsewhere.mark.offset);
  out.put(elsewhere.mark.bytes);
  out.put(elsewhere.mark.checksum);
  out.putText(elsewhere.storeName);
  out.putText(elsewhere.nameMeanwhile);
  return out.bytes();
}

std::optional<PayloadElsewhere> decodeElsewhere(const std::byte* data, std::size_t size)
{
  ByteReader in(data, size);
  PayloadElsewhere elsewhere;
  elsewhere.bytes = in.get<std::uint64_t>();
  elsewhere.mark.offset = in.get<std::uint64_t>();
  elsewhere.mark.bytes = in.get<std::uint32_t>();
  elsewhere.mark.checksum = in.get<std::uint32_t>();
  elsewhere.storeName = in.getText();
  elsewhere.nameMeanwhile = in.getText();
  if (!in.ok() || in.remaining() != 0 || !isPlainName(elsewhere.storeName) ||
    !isPlainName(elsewhere.nameMeanwhile))
  {
    return std::nullopt;
  }
  return elsewhere;
}

Result<std::shared_ptr<const ByteSource>> openElsewhere(
  const std::string& path, const PayloadElsewhere& elsewhere)
{
  // In this order: a build that ends in between has renamed the first to the second.
  for (const std::string& name : { elsewhere.nameMeanwhile, elsewhere.storeName })
  {
    Result<std::shared_ptr<const ByteSource>> file = openBytes(beside(path, name));
    if (file && holds(**file, elsewhere))
    {
      return file;
    }
  }
  return makeError(Error::Kind::Truncated,
    "'" + path + "' shows parts of '" + elsewhere.storeName +
      "', which are not there any more: its build has ended; open '" + elsewhere.storeName +
      "' if it is there, otherwise build again");
}

} // namespace pointfront
