#pragma once

#include "pointfront/Disk/ByteSource.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>

namespace pointfront
{

/// A file on a disk.
class InputFile final : public ByteSource
{
public:
  static Result<std::unique_ptr<const InputFile>> open(const std::string& path);
  ~InputFile() override;

  std::uint64_t device() const override { return device_; }
  Result<void> read(const ByteRange* ranges, std::size_t count) const override;
  bool isLocked() const override;
  bool isStillNamed() const override;

private:
  InputFile(std::string path, int descriptor, std::uint64_t bytes, std::uint64_t device);
  Result<void> readOne(ByteRange range) const;

  int descriptor_;
  std::uint64_t device_;
};

} // namespace pointfront
