#pragma once

#include "Command.h"
#include "StoreEstimate.h"

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
    const std::string& path, const PointFileOpener& opener, nlohmann::ordered_json& reports);
  Result<void> tellStore(const std::string& path, nlohmann::ordered_json& reports);
  Result<void> tellSource(
    const std::string& path, const PointFileOpener& opener, nlohmann::ordered_json& reports);
  /// For a store of that input alone.
  StoreEstimate estimate(const EstimatedInput& input);

  std::vector<std::string> inputs_;
  bool json_ = false;
  bool together_ = false;
  bool statistics_ = false;
  std::uint64_t memoryBytes_ = ScanOptions::usualMemoryBytes;
  StatisticsOptions options_;
  RecordLook look_;
  StoreEstimate estimates_; ///< for a store of all inputs that are no stores
};

} // namespace pointfront
