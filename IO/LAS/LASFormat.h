#pragma once

#include "pointfront/Base/RawBytes.h"
#include "pointfront/Points/PointSource.h"

namespace pointfront
{

/// LAS 1.0 to 1.4, point formats 0 to 10, and LAZ (through LASzip).
class LASFormat final : public PointSourceFormat
{
public:
  std::string name() const override { return "LAS/LAZ"; }
  std::vector<std::string> extensions() const override { return { "las", "laz" }; }
  bool accepts(const std::string& path) const override;
  Result<std::unique_ptr<PointSource>> open(const std::string& path) const override;
  /// The same, of the bytes of a file that was read already. They outlive the points.
  static Result<std::unique_ptr<PointSource>> openBytes(
    const std::string& path, const RawBytes& bytes);
};

} // namespace pointfront
