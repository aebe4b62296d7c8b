#pragma once

#include "EstimatedInput.h"

#include <nlohmann/json_fwd.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>

namespace pointfront
{

/// Tells what a store of some point files and pictures of it take, before anything is built.
/// Ranges   least and most: of what docs/tradeoffs.md measured, and of what the attributes that
///          vary take in stores. A store that is given normals, or less memory, takes longer.
/// Keys     store_bytes, build_seconds (null where a format was not measured), build_memory_bytes,
///          first_picture and complete_picture (milliseconds, bytes_read, and of the complete one
///          technique, error_px and memory_bytes), source.
class StoreEstimate
{
public:
  using Range = std::array<double, 2>; ///< least and most

  void add(const EstimatedInput& input);

  /// How many were added: one store would hold all.
  std::size_t inputs() const { return inputs_; }

  nlohmann::ordered_json json() const;
  /// For people: lines that follow those of sourceText().
  std::string text() const;

private:
  Range storeBytes() const;
  std::optional<Range> buildSeconds() const;
  Range buildMemory() const;

  std::size_t inputs_ = 0;
  double points_ = 0.0;
  std::size_t attributes_ = 0; ///< the input that has most has so many
  Range recordBytes_{ 0.0, 0.0 }; ///< all points together
  std::optional<Range> readSeconds_ = Range{ 0.0, 0.0 };
};

} // namespace pointfront
