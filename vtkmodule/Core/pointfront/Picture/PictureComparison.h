#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Picture/Picture.h"

#include <array>
#include <cstdint>
#include <optional>

namespace pointfront
{

/// How far a drawn picture is from a reference picture.
struct PictureComparison
{
  bool identical = false; ///< every pixel of the pictures has the same colour
  std::uint64_t pixels = 0; ///< compared: those of the mask, or all
  double psnrDecibels = 0.0; ///< over red, green and blue; infinite where none differs
  double ssim = 0.0; ///< mean of structuralSimilarity()
  double shareOver8 = 0.0; ///< share of the pixels that differ by more than 8 of 255 in a channel
  double meanDifference = 0.0; ///< mean of grey pictures (0.299 R + 0.587 G + 0.114 B), 0 to 255
  std::optional<double> holes; ///< % of the mask's pixels; none without a mask
  std::optional<double> bloat; ///< likewise
  std::optional<std::array<std::uint8_t, 3>> background; ///< that holes and bloat were told by
};

struct ComparisonOptions
{
  /// Where the reference shows a surface: white inside, black outside, grey for a pixel that is
  /// partly covered. Inside is what is at least half white (128); a pixel that is transparent is
  /// outside. nullptr: what the reference draws, if the background is known; else there is none,
  /// and all pixels are compared.
  const Picture* mask = nullptr;
  /// Not given: the most frequent colour of the reference where the mask is black. That is the
  /// background by the mask's own word, whatever the drawn picture shows.
  std::optional<std::array<std::uint8_t, 3>> background;
};

/// Compares colours and ignores opacity, except that wholly transparent pixels are background. hole
/// a pixel that is white in the mask (255) and background in `drawn` bloat a pixel that is black in
/// the mask (0) and not background in `drawn` Pixels that the mask covers partly are neither:
/// either answer is right there.
/// Errors  BadArgument for sizes that differ, a mask without a pixel inside, and a background that
///         has to be told: where the mask leaves nothing outside, or no colour has half of that.
Result<PictureComparison> comparePictures(
  const Picture& drawn, const Picture& reference, const ComparisonOptions& options = {});

} // namespace pointfront
