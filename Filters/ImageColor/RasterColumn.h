#pragma once

#include "RasterFile.h"

#include "pointfront/Base/Result.h"
#include "pointfront/Points/AttributePass.h"
#include "pointfront/Points/AttributeSchema.h"
#include "pointfront/Points/PointSource.h"

#include <cstddef>
#include <string>
#include <vector>

namespace pointfront
{

/// A column of one source that takes values from pixels.
/// Colour   "rgb": grey becomes three equal channels; 8 bits become 16 by v * 257, 16 become 8 by
///          v / 257, rounded. A 16-bit column that holds colours of 8 bits (as many LAS files do)
///          is written in 8 bits, so that its points stay comparable; beside images of 16 bits its
///          own colours are widened.
/// Values   the column of that name keeps its type if the source has one, and takes what that type
///          can hold; a new column has the type of the images (well-known names: their own).
class RasterColumn
{
public:
  /// `files`: the mosaic, not empty.
  /// Errors  BadArgument: the source's column has another number of components or is scaled.
  static Result<RasterColumn> make(const std::string& name, const std::vector<RasterFile>& files,
    const PointSource& source, const PassResources& resources);

  const Attribute& attribute() const { return attribute_; }
  /// True if the source has the column; else new ones begin as zeros.
  bool isOld() const { return old_; }
  /// The image that the source's colours have 16 bits from. Empty: there is none, or the source's
  /// own colours have 16 bits.
  const std::string& wideImage() const { return wideImage_; }
  /// Makes the source's own values, before any is taken from a pixel, those of this column.
  void widen(std::vector<std::byte>& values) const;

  enum class Outcome
  {
    Taken,
    NoData, ///< the pixel says nothing
    NotHeld ///< the column's type cannot hold the value: the point keeps what it had
  };
  /// `to`: the point's place in the column.
  Outcome store(const RasterFile& file, const std::byte* pixel, std::byte* to) const;

private:
  Outcome storeColour(const RasterFile& file, const std::byte* pixel, std::byte* to) const;
  Outcome storeValues(const RasterFile& file, const std::byte* pixel, std::byte* to) const;

  Attribute attribute_;
  bool old_ = false;
  bool colour_ = false;
  bool eightBitsInSixteen_ = false; ///< images of 8 bits are written in 8
  bool widens_ = false;
  std::string wideImage_;
};

} // namespace pointfront
