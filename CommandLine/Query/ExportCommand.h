#pragma once

#include "Command.h"
#include "QueryArguments.h"
#include "SinkFormats.h"

#include "pointfront/Export/StoreExport.h"

#include <cstdint>
#include <string>

namespace pointfront
{

/// `pointfront export`: points of a store -> an ordinary point file, its kind by the extension.
class ExportCommand final : public Command
{
public:
  void declare(CLI::App& program) override;
  Result<void> run() override;

private:
  void declareCOPC();
  /// Throws what CLI11 knows as wrong usage.
  void checkOptions();
  /// The file can be written, and is none of those that are read.
  Result<void> checkTarget(const StoredCloud& store) const;
  /// COPC: the reading's part of --memory.
  Result<void> shareMemory(const StoredCloud& store, ExportSelection& selection);
  /// JSON of --stats.
  std::string statistics(std::uint64_t points, double seconds) const;
  /// Gives how many points the file has; warns of what it could not keep.
  Result<std::uint64_t> write(const StoredCloud& store, const ExportSelection& selection);

  std::string storePath_;
  std::string outputPath_;
  QueryArguments arguments_;
  std::string copcPath_; ///< --copc, which is --output by another name
  SinkChoice sinkChoice_;
  std::uint64_t memoryBytes_ = 0; ///< 0: not given
  bool replace_ = false;
  std::string statisticsPath_; ///< empty: not given
  std::string progress_ = "auto";
};

} // namespace pointfront
