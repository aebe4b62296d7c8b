#pragma once

#include "Command.h"

#include "LASIndexing.h"

#include <cstdint>
#include <string>

namespace pointfront
{

/// `pointfront index`: a side file that makes an unchanged LAS file a stored cloud.
class IndexCommand final : public Command
{
public:
  void declare(CLI::App& program) override;
  Result<void> run() override;

private:
  std::string inputPath_;
  std::string sidePath_;
  LASIndexOptions options_;
  std::string progress_ = "auto";
  bool json_ = false;
};

/// The keys of `index --json`.
std::string indexReportJson(const LASIndexReport& report, std::uint64_t peakBytes);

} // namespace pointfront
