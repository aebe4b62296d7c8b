#pragma once

#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// The address of a collection at one of its epochs: `city.pfcollection#epoch=2024`.
struct EpochAddress
{
  std::string file; ///< path or address of the collection
  std::optional<std::string> epoch; ///< nothing: all its tiles

  /// Every other address is a file's own, and so is the path of a file with such a name.
  static EpochAddress of(const std::string& address);
  std::string text() const;
};

/// An epoch of a collection on a scale of time.
struct EpochTime
{
  double time = 0.0;
  std::string name; ///< a date or a name
};

/// Epochs in the order of time. If all are dates (2024, 2024-07 or 2024-07-15), times are years:
/// months are twelfths, days 365ths of a year from its beginning, 366ths in leap years. Else times
/// are 0, 1, 2 ... in the order that is given; likewise where two dates are one time.
std::vector<EpochTime> timesOf(const std::vector<std::string>& epochs);

} // namespace pointfront
