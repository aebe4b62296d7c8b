#pragma once

#include "Command.h"

#include "pointfront/Points/PointFileOpener.h"
#include "pointfront/Statistics/PointStatistics.h"

#include <nlohmann/json_fwd.hpp>

#include <string>
#include <vector>

namespace pointfront
{

/// `pointfront info`: what stores and point files say of themselves; with --stats what their points
/// are like.
class InfoCommand final : public Command
{
public:
  void declare(CLI::App& program) override;
  Result<void> run() override;

private:
  Result<void> tell(
    const std::string& path, const PointFileOpener& opener, nlohmann::ordered_json& reports) const;
  Result<void> tellStore(const std::string& path, nlohmann::ordered_json& reports) const;
  Result<void> tellSource(
    const std::string& path, const PointFileOpener& opener, nlohmann::ordered_json& reports) const;

  std::vector<std::string> inputs_;
  bool json_ = false;
  bool together_ = false;
  bool statistics_ = false;
  std::uint64_t memoryBytes_ = ScanOptions::usualMemoryBytes;
  StatisticsOptions options_;
};

} // namespace pointfront
