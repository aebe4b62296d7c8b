#include "pointfront/Store/PayloadElsewhere.h"

#include "pointfront/Codec/ByteStream.h"
#include "pointfront/Codec/Checksum.h"

#include <filesystem>

namespace pointfront
{
namespace
{
bool holds(const InputFile& file, const PayloadElsewhere& elsewhere)
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
} // namespace

PayloadElsewhere describeElsewhere(
  std::string storeName, std::uint64_t bytes, const BlockDirectory& directory)
{
  PayloadElsewhere elsewhere{ std::move(storeName), bytes, {} };
  elsewhere.mark.checksum = checksumOf(nullptr, 0);
  for (std::uint32_t node = 0; node < directory.nodeCount(); ++node)
  {
    if (directory.isElsewhere(node) && directory.payloadBytes(node) > 0 &&
      directory.offset(node) > elsewhere.mark.offset)
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
  const bool plainName = !elsewhere.storeName.empty() &&
    elsewhere.storeName.find('/') == std::string::npos &&
    elsewhere.storeName.find('\0') == std::string::npos;
  if (!in.ok() || in.remaining() != 0 || !plainName)
  {
    return std::nullopt;
  }
  return elsewhere;
}

Result<std::unique_ptr<const InputFile>> openElsewhere(
  const std::string& path, const PayloadElsewhere& elsewhere)
{
  const std::string store =
    (std::filesystem::path(path).parent_path() / elsewhere.storeName).string();
  // In this order: a build that ends in between has renamed the first to the second.
  for (const std::string& name : { store + ".tmp", store })
  {
    Result<std::unique_ptr<const InputFile>> file = InputFile::open(name);
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
