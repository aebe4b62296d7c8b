#pragma once

#include <cstddef>
#include <cstdint>

namespace pointfront
{

/// The processes that draw the pieces of one cloud, while they draw. Every one of them calls the
/// same functions in the same order, whatever it has to draw.
class PictureExchange
{
public:
  virtual ~PictureExchange() = default;

  /// Makes each of the `count` depths the smallest of all processes. False, on all of them, if they
  /// do not agree in the count; nothing has changed then.
  virtual bool nearest(float* depths, std::size_t count) = 0;
  /// Makes each of the `count` sums that of all processes.
  virtual void sum(std::uint32_t* sums, std::size_t count) = 0;
};

} // namespace pointfront
