#pragma once

#include "pointfront/Base/RawBytes.h"
#include "pointfront/Base/Result.h"
#include "pointfront/Store/PayloadDirectory.h"
#include "pointfront/Store/PointStore.h"

#include <array>
#include <cstddef>
#include <cstdint>

namespace pointfront
{

/// Takes payloads out of a store as they lie there, for who writes them into another one. Reads
/// ahead in large pieces, so it is quick for nodes in the order of the file.
/// Threads  one.
class PayloadCopy
{
public:
  /// `store` must outlive it, and have its payloads in its own file.
  explicit PayloadCopy(const PointStore& store)
    : store_(store)
  {
  }
  /// That of a node, which has so many points. The bytes stay until the next call.
  /// Errors  those of ByteSource; Corrupt: a checksum does not match.
  Result<StoredPayload> of(NodeIndex node, std::uint32_t points);

private:
  /// A piece of the file in memory.
  struct Piece
  {
    std::uint64_t begin = 0; ///< in the file
    std::size_t size = 0;
    RawBytes room;
  };
  Result<const std::byte*> at(Piece& piece, std::uint64_t offset, std::size_t size) const;

  const PointStore& store_;
  Piece records_;
  std::array<Piece, payloadPieces> payloads_; ///< a place in the file for each run of a node
};

} // namespace pointfront
