#pragma once

#include "Command.h"
#include "QueryArguments.h"
#include "SinkFormats.h"

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
  std::string storePath_;
  std::string outputPath_;
  QueryArguments arguments_;
  SinkChoice sinkChoice_;
  bool replace_ = false;
  std::string progress_ = "auto";
};

} // namespace pointfront
