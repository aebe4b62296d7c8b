#pragma once

#include "Command.h"

#include <cstdint>
#include <string>

namespace pointfront
{

/// `pointfront generate`: a made-up airborne survey as a point file, for trials and benchmarks.
/// The same number of points and the same seed give the same file.
class GenerateCommand final : public Command
{
public:
  void declare(CLI::App& program) override;
  Result<void> run() override;

private:
  std::string outputPath_;
  std::uint64_t points_ = 0;
  std::uint64_t seed_ = 24; ///< that landscape has every class in 300,000 points
  bool replace_ = false;
  std::string progress_ = "auto";
};

} // namespace pointfront
