#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Disk/SpillFile.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// Pieces of a file that are known early and come late in it: until then they lie in a temporary
/// file without a name. A copy of this object has the pieces that were there when it was made.
/// Threads  one thread writes; others may read copies meanwhile.
/// Errors   those of SpillFile.
class LatePieces
{
public:
  /// The temporary file lies in `folder`, and is made with the first piece.
  explicit LatePieces(std::string folder)
    : folder_(std::move(folder))
  {
  }

  /// Begins a piece, whose number is larger than those of all earlier ones.
  void begin(std::uint32_t number) { places_.push_back({ number, 0, end_ }); }
  /// Appends to the piece that was begun last.
  Result<void> append(const std::byte* data, std::size_t size);
  Result<void> append(const std::vector<std::byte>& bytes)
  {
    return append(bytes.data(), bytes.size());
  }

  bool contains(std::uint32_t number) const { return find(number) != nullptr; }
  Result<std::vector<std::byte>> read(std::uint32_t number) const;
  /// A part of a piece: so many bytes from byte `begin` of it on.
  Result<std::vector<std::byte>> read(
    std::uint32_t number, std::uint64_t begin, std::size_t size) const;

private:
  struct Place
  {
    std::uint32_t number = 0;
    std::size_t bytes = 0;
    std::uint64_t offset = 0; // in file_
  };
  const Place* find(std::uint32_t number) const;

  std::string folder_;
  std::shared_ptr<SpillFile> file_; // null: nothing was appended
  std::vector<Place> places_; // by number
  std::uint64_t end_ = 0; // the end of file_
};

} // namespace pointfront
