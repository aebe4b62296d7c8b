#pragma once

#include "pointfront/Points/PointSource.h"

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// Which code of a new base stands for each code of an old one: the smallest whose radius is not
/// smaller. All unknown for an old base of 0.
std::array<std::byte, 256> recodedRadii(double oldBase, double newBase);

/// Sources whose codes of `splat_radius` (SplatRadius.h) are multiples of one base.
struct CommonRadii
{
  /// The same points in the same chunks; they refer to the originals. Empty: the originals agree.
  std::vector<std::unique_ptr<PointSource>> sources;
  std::vector<std::string> warnings; ///< whose radii are not known
};

/// The base is the largest. A radius becomes the smallest code of it that is not smaller: at most
/// 4.5 % larger, none at all where bases are powers of two apart, as stores have them. Codes of a
/// source that does not say its base, beside others that do, become unknown.
CommonRadii commonRadii(const std::vector<std::unique_ptr<PointSource>>& sources);

} // namespace pointfront
