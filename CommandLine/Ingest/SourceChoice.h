#pragma once

#include "SourceFormats.h"

#include "pointfront/Build/StoreBuilder.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace pointfront
{

/// The options of `pointfront build` that say how its input files are to be read.
class SourceChoice
{
public:
  void declare(CLI::App& app);
  /// How colours of 16 bits are taken.
  ColourDepth colourDepth() const;
  /// Error BadArgument: an option for text files, of which there is none among the inputs.
  Result<void> checkAgainst(const std::vector<std::unique_ptr<PointSource>>& inputs) const;
  /// The options of all formats; threads and temporary folder are those of the build.
  SourceOptions options(const BuildOptions& build) const;

private:
  std::vector<std::string> columns_;
  std::string colourDepth_ = "auto";
  TextChoice text_;
};

} // namespace pointfront
