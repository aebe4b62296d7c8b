#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Picture/Picture.h"

#include <cstdint>
#include <string>

namespace pointfront
{

/// The most that a file may ask for.
struct PNGLimits
{
  std::uint64_t pixels = std::uint64_t(1) << 29; ///< 2 GiB of Picture: 20000 x 20000 fits
};

/// A PNG file as a picture of 8 bits a channel.
/// Takes   grey, palette, RGB, with opacity or without, 1 to 16 bits a channel, interlaced or not.
///         16 bits are scaled to the nearest of 8; what is marked transparent has opacity 0; a
///         picture without opacity has 255. Gamma and colour profiles are not applied.
/// Errors  NotFound, Unreadable; BadFormat for what is no PNG or contradicts itself; Truncated
///         where the file ends early; Unsupported above `limits` and NoMemory, both before a pixel
///         is read: a short file that claims to be huge costs nothing.
Result<Picture> readPNG(const std::string& path, const PNGLimits& limits = {});

} // namespace pointfront
