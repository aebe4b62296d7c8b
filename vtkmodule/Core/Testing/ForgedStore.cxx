#include "ForgedStore.h"

#include "SampleStore.h"

#include "pointfront/Codec/Checksum.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace pointfront
{

ForgedStore::ForgedStore(const std::string& soundPath)
  : bytes_(fileBytes(soundPath))
{
  const auto readHeader = decodeHeader(bytes_.data(), bytes_.size(), bytes_.size(), soundPath);
  EXPECT_TRUE(readHeader);
  header = *readHeader;
  const auto readFooter = decodeFooter(bytes_.data() + header.footerOffset, header, soundPath);
  EXPECT_TRUE(readFooter);
  footer = *readFooter;
}

SectionEntry& ForgedStore::entry(SectionKind kind)
{
  return const_cast<SectionEntry&>(*footer.find(kind));
}

std::vector<std::byte> ForgedStore::section(SectionKind kind) const
{
  const SectionEntry& found = *footer.find(kind);
  const auto begin = bytes_.begin() + static_cast<std::ptrdiff_t>(found.offset);
  return std::vector<std::byte>(begin, begin + static_cast<std::ptrdiff_t>(found.bytes));
}

void ForgedStore::replaceSection(SectionKind kind, const std::vector<std::byte>& bytes)
{
  SectionEntry& found = entry(kind);
  ASSERT_EQ(bytes.size(), found.bytes);
  std::copy(bytes.begin(), bytes.end(), bytes_.begin() + static_cast<std::ptrdiff_t>(found.offset));
  found.checksum = checksumOf(bytes.data(), bytes.size());
}

void ForgedStore::write(const std::string& path)
{
  const std::vector<std::byte> headerBytes = encodeHeader(header);
  std::copy(headerBytes.begin(), headerBytes.end(), bytes_.begin());
  const std::vector<std::byte> footerBytes = encodeFooter(footer);
  std::copy(footerBytes.begin(), footerBytes.end(),
    bytes_.end() - static_cast<std::ptrdiff_t>(footerBytes.size()));
  writeFile(path, bytes_);
}

} // namespace pointfront
