#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace pointfront::test
{

/// A small TIFF, written by libtiff.
struct WrittenTiff
{
  int width = 4;
  int height = 3;
  int channels = 1;
  int bits = 8; ///< fewer: 1, 2 or 4, in strips or one tile
  int sampleFormat = 1; ///< 1 unsigned, 2 signed, 3 floating point
  std::vector<double> values; ///< row by row, all channels; elements are converted
  std::vector<double> scale;
  std::vector<double> tie;
  std::vector<double> matrix;
  std::vector<std::uint16_t> keys;
  std::string noData;
  bool alpha = false; ///< the last channel
  bool palette = false; ///< colour i is (255 - i, i, 7)
  bool whiteIsZero = false;
  int tile = 0; ///< side of a tile, 0: strips; a multiple of 16
  int stripRows = 1; ///< rows of a strip

  /// North-up pixels of `size`, the corner at (x, y).
  WrittenTiff& at(double x, double y, double size = 1.0)
  {
    scale = { size, size, 0.0 };
    tie = { 0.0, 0.0, 0.0, x, y, 0.0 };
    return *this;
  }
  /// Below the tests' folder; a failure is a test failure.
  std::string write(const std::string& name) const;
};

} // namespace pointfront::test
