#pragma once

#include "pointfront/Points/PointSource.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// Opens point files of all families that a program carries. Readers do not know each other, and
/// filters do not know readers: the program that combines them gives the process an opener.
/// Threads  const functions from any thread; use() and ofProcess() from any thread.
class PointFileOpener
{
public:
  virtual ~PointFileOpener() = default;
  /// Lower case, without the dot.
  virtual std::vector<std::string> extensions() const = 0;
  virtual Result<std::unique_ptr<PointSource>> open(const std::string& path) const = 0;

  /// Makes it the opener of this process.
  static void use(std::shared_ptr<const PointFileOpener> opener);
  /// Null if the program set no opener.
  static std::shared_ptr<const PointFileOpener> ofProcess();
};

} // namespace pointfront
