#pragma once

#include "pointfront/Store/StoreFormat.h"

#include <functional>
#include <string>
#include <vector>

namespace pointfront
{

/// The bytes of a sound store, to be changed in ways that checksums do not show: what is written
/// back has all of them right.
class ForgedStore
{
public:
  explicit ForgedStore(const std::string& soundPath);

  StoreHeader header;
  StoreFooter footer;

  std::vector<std::byte>& bytes() { return bytes_; }
  /// The section's bytes, for reading.
  std::vector<std::byte> section(SectionKind kind) const;
  /// Puts other bytes, as many, in its place.
  void replaceSection(SectionKind kind, const std::vector<std::byte>& bytes);
  /// Signs header and footer as they stand now and writes the file.
  void write(const std::string& path);

private:
  SectionEntry& entry(SectionKind kind);
  std::vector<std::byte> bytes_;
};

} // namespace pointfront
