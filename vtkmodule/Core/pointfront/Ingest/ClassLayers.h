#pragma once

#include "pointfront/Records/RecordLayout.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace pointfront
{

/// Which layer a record belongs to: one for each object class, or one for all points.
class ClassLayers
{
public:
  ClassLayers() = default; ///< one layer
  /// `offset`: of the class, one byte, in a record; `classes`: ascending, those that there are.
  ClassLayers(std::size_t offset, std::vector<std::uint8_t> classes)
    : offset_(offset)
    , classes_(std::move(classes))
  {
    for (std::size_t layer = 0; layer < classes_.size(); ++layer)
    {
      layerOf_[classes_[layer]] = static_cast<std::uint8_t>(layer);
    }
  }

  bool byClass() const { return offset_.has_value(); }
  const std::vector<std::uint8_t>& classes() const { return classes_; } ///< class of each layer
  std::size_t layerOf(const std::byte* record) const
  {
    return offset_ ? layerOf_[std::to_integer<std::uint8_t>(record[*offset_])] : 0u;
  }

private:
  std::optional<std::size_t> offset_;
  std::vector<std::uint8_t> classes_{ 0 };
  std::array<std::uint8_t, 256> layerOf_{};
};

} // namespace pointfront
