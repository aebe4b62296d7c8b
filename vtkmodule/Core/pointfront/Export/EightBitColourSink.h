#pragma once

#include "pointfront/Points/ForwardingSink.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace pointfront
{

/// Points on their way into a sink, with 16-bit colours narrowed to the 8 bits that readers of PLY
/// and PCD expect.
/// Values    the upper byte, as of 8-bit colours that a writer of LAS shifted or repeated. If no
///           colour is above 255, the lower byte: those are 8-bit colours already.
/// Lost      findings() counts the points whose colours 8 bits do not hold.
/// Errors    BadArgument for a larger colour then: ranges of COPC and EPT are those of some points.
/// Others    points without such colours pass as they are.
class EightBitColourSink final : public ForwardingSink
{
public:
  explicit EightBitColourSink(std::unique_ptr<PointSink> sink);

  Result<void> begin(const SinkDescription& description) override;
  Result<void> append(const PointBatch& batch) override;
  std::vector<std::string> findings() const override;

private:
  void narrow(const std::vector<std::byte>& wide, std::vector<std::byte>& bytes);

  std::optional<std::size_t> colours_; ///< the column to narrow, since begin()
  bool areSmall_ = false; ///< no colour is said to be above 255
  bool wasMisjudged_ = false; ///< but one is
  PointBatch batch_; ///< the last one, narrowed
  std::uint64_t rounded_ = 0; ///< points
};

} // namespace pointfront
