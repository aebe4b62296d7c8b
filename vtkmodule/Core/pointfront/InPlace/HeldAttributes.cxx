#include "pointfront/InPlace/HeldAttributes.h"

namespace pointfront
{
namespace
{
constexpr std::size_t blockRowBytes = 24;

void putBlock(ByteWriter& out, const ValueBlock& block)
{
  out.put(block.offset);
  out.put(block.bytes);
  out.put(block.checksum);
  out.put(static_cast<std::uint8_t>(block.codec));
  for (int reserved = 0; reserved < 7; ++reserved)
  {
    out.put(std::uint8_t(0));
  }
}

ValueBlock getBlock(ByteReader& in)
{
  ValueBlock block;
  block.offset = in.get<std::uint64_t>();
  block.bytes = in.get<std::uint32_t>();
  block.checksum = in.get<std::uint32_t>();
  block.codec = BlockCodec(in.get<std::uint8_t>());
  std::uint8_t reserved[7];
  in.getBytes(reserved, sizeof reserved);
  return block;
}

} // namespace

void putHeldAttributes(ByteWriter& out, const SideFileContent& content)
{
  if (content.held == 0)
  {
    return;
  }
  out.put(content.held);
  for (const ValueBlock& block : content.table.blocks)
  {
    putBlock(out, block);
  }
}

std::string heldAttributesFault(
  ByteReader& in, const SideFilePayload& payload, SideFileContent& content)
{
  const std::uint64_t nodes = content.table.nodes.size();
  const std::size_t attributes = content.stored.description.schema.size();
  content.held = in.get<std::uint32_t>();
  if (content.held == 0 || content.held > mostHeldAttributes || content.held > attributes ||
    in.remaining() != nodes * content.held * blockRowBytes)
  {
    return "the attributes that it holds are not those of its description";
  }
  for (std::uint64_t i = 0; i < nodes * content.held; ++i)
  {
    const ValueBlock block = getBlock(in);
    if (!payload.holds(block.offset, block.bytes) ||
      !knownBlockCodec(static_cast<std::uint8_t>(block.codec)))
    {
      return "node " + std::to_string(i / content.held) +
        ": its values lie outside the file, or are coded in an unknown way";
    }
    content.table.blocks.push_back(block);
  }
  return {};
}

} // namespace pointfront
