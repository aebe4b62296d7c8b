#pragma once

#include "pointfront/Points/PointSource.h"

#include <string>
#include <utility>
#include <vector>

namespace pointfront
{

/// A family of point files that is known and not read: it says so, why, and what to do instead.
class RefusedFormat final : public PointSourceFormat
{
public:
  /// A mark of the family: the beginning of a file, or its name.
  struct Mark
  {
    std::string signature; ///< empty: by file name
    std::string fileName;
  };
  RefusedFormat(std::string name, std::vector<std::string> extensions, Mark mark, std::string why)
    : name_(std::move(name))
    , extensions_(std::move(extensions))
    , mark_(std::move(mark))
    , why_(std::move(why))
  {
  }
  std::string name() const override { return name_; }
  std::vector<std::string> extensions() const override { return extensions_; }
  bool accepts(const std::string& path) const override;
  /// Always Unsupported.
  Result<std::unique_ptr<PointSource>> open(const std::string& path) const override;

private:
  std::string name_;
  std::vector<std::string> extensions_;
  Mark mark_;
  std::string why_;
};

} // namespace pointfront
