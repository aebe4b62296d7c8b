#pragma once

#include "Command.h"

#include "LASIndexing.h"
#include "pointfront/Build/OpenedInputs.h"
#include "pointfront/Points/PassChoice.h"

#include <cstdint>
#include <string>
#include <vector>

namespace pointfront
{

/// `pointfront index`: a side file that makes an unchanged LAS file a stored cloud.
class IndexCommand final : public Command
{
public:
  void declare(CLI::App& program) override;
  Result<void> run() override;

private:
  /// The files that can be indexed; all that cannot are named in the Error, or added to `skipped`.
  Result<std::vector<std::string>> findFiles(std::vector<InputFault>& skipped) const;

  std::vector<std::string> inputs_;
  std::string sidePath_;
  /// The pass that `--normals` asks for.
  Result<void> chooseNormals();

  LASIndexOptions options_;
  std::string normals_ = "none";
  CLI::Option* neighboursOption_ = nullptr;
  std::uint32_t normalsNeighbours_ = PassChoice().normalsNeighbours;
  OnFault onFault_ = OnFault::Stop;
  std::string progress_ = "auto";
  bool json_ = false;
};

/// The keys of `index --json`; of several files `report` is their sum. Null: nothing is skipped.
std::string indexReportJson(
  const LASIndexReport& report, const std::vector<InputFault>* skipped, std::uint64_t peakBytes);

} // namespace pointfront
