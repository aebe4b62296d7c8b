#pragma once

#include "pointfront/Points/ScalarType.h"

#include <cstddef>
#include <cstdint>

namespace pointfront
{

/// Numbers that lie at equal distances in memory, in either byte order; need not be aligned.
struct RecordNumbers
{
  const std::byte* first = nullptr;
  std::size_t stride = 0;
  ScalarType type = ScalarType::Float32;
  bool swapped = false; ///< byte order is not this machine's
};

bool machineIsLittleEndian();

/// The first `count` of them as doubles. Pure.
void gatherNumbers(const RecordNumbers& numbers, std::size_t count, double* to);
/// The same as integers, of a type that has 64 bits and is no float.
void gatherWholes(const RecordNumbers& numbers, std::size_t count, std::uint64_t* to);
/// Whether doubles round some numbers of the type.
bool wantsWholes(ScalarType type);

} // namespace pointfront
