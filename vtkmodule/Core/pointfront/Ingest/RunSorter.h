#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Records/RecordLayout.h"
#include "pointfront/Records/RecordPool.h"

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

namespace pointfront
{

/// A run of records in the pool.
struct Piece
{
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

/// A run of records of one part.
struct PartPiece
{
  std::uint32_t part = 0;
  Piece piece;
};

/// Sorts runs of the pool by part, in place and stable. One instance a thread.
class RunSorter
{
public:
  RunSorter(RecordPool& pool, std::size_t recordBytes)
    : pool_(pool)
    , recordBytes_(recordBytes)
  {
  }

  Result<void> load(const Piece& run)
  {
    run_ = run;
    in_.resize(run.count * recordBytes_);
    return pool_.read(run.first, run.count, in_.data());
  }
  std::byte* record(std::uint64_t i) { return in_.data() + i * recordBytes_; }

  /// `partOf(record)` for each record of the loaded run; gives the pieces in part order.
  template <typename PartOf>
  Result<std::vector<PartPiece>> sort(std::uint32_t partCount, PartOf partOf)
  {
    parts_.resize(run_.count);
    starts_.assign(partCount + 1, 0);
    for (std::uint64_t i = 0; i < run_.count; ++i)
    {
      parts_[i] = partOf(record(i));
      ++starts_[parts_[i] + 1];
    }
    std::vector<PartPiece> pieces;
    for (std::uint32_t part = 0; part < partCount; ++part)
    {
      if (const std::uint64_t count = starts_[part + 1]; count > 0)
      {
        pieces.push_back({ part, { run_.first + starts_[part], count } });
      }
      starts_[part + 1] += starts_[part];
    }
    if (pieces.size() == 1)
    {
      out_ = in_;
    }
    else
    {
      scatter();
    }
    if (Result<void> done = pool_.write(run_.first, run_.count, out_.data()); !done)
    {
      return done.error();
    }
    return pieces;
  }

private:
  void scatter()
  {
    out_.resize(in_.size());
    for (std::uint64_t i = 0; i < run_.count; ++i)
    {
      std::memcpy(out_.data() + starts_[parts_[i]]++ * recordBytes_, record(i), recordBytes_);
    }
  }

  RecordPool& pool_;
  std::size_t recordBytes_;
  Piece run_;
  std::vector<std::byte> in_;
  std::vector<std::byte> out_;
  std::vector<std::uint32_t> parts_;
  std::vector<std::uint64_t> starts_;
};

} // namespace pointfront
