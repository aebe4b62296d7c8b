#pragma once

#include "pointfront/Disk/ByteSource.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

namespace pointfront
{

/// A source of which some parts are in memory: reads inside them cost nothing. So tables that a
/// reader looks up piece by piece are one read of a far source, and the reader does not know it.
/// Threads  as ByteSource; what is held does not change.
class HeldBytes final : public ByteSource
{
public:
  struct Part
  {
    std::uint64_t offset = 0;
    std::size_t size = 0;
  };
  /// Reads the parts together. They must lie in the source.
  static Result<std::shared_ptr<const ByteSource>> hold(
    std::shared_ptr<const ByteSource> source, const std::vector<Part>& parts);

  std::uint64_t device() const override { return source_->device(); }
  ReadCost cost() const override { return source_->cost(); }
  bool holds(std::uint64_t offset, std::size_t size) const override
  {
    return find(offset, size) != nullptr;
  }
  /// Reads the ranges that are not held, together.
  Result<void> read(const ByteRange* ranges, std::size_t count) const override;
  Result<void> readUntil(
    const ReadStop& stop, const ByteRange* ranges, std::size_t count) const override;
  bool isLocked() const override { return source_->isLocked(); }
  bool isStillNamed() const override { return source_->isStillNamed(); }

private:
  struct Held
  {
    std::uint64_t offset = 0;
    RawBytes bytes;
  };
  explicit HeldBytes(std::shared_ptr<const ByteSource> source);
  const std::byte* find(std::uint64_t offset, std::size_t size) const;
  bool copy(const ByteRange& range) const;
  std::vector<ByteRange> copyHeld(const ByteRange* ranges, std::size_t count) const;

  std::shared_ptr<const ByteSource> source_;
  std::vector<Held> held_;
};

} // namespace pointfront
