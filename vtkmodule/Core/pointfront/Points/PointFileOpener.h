#pragma once

#include "pointfront/Points/PointSource.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// Opens point files of all families that a program carries (IO/Formats puts them together).
/// Threads  const functions from any thread.
class PointFileOpener
{
public:
  virtual ~PointFileOpener() = default;
  /// Lower case, without the dot.
  virtual std::vector<std::string> extensions() const = 0;
  virtual Result<std::unique_ptr<PointSource>> open(const std::string& path) const = 0;
};

} // namespace pointfront
