#pragma once

#include "pointfront/Points/PassChoice.h"

#include <CLI/CLI.hpp>

namespace pointfront
{

/// The options of `pointfront build` about heights.
class HeightArguments
{
public:
  void declare(CLI::App& app);
  void fill(PassChoice& choice) const;

private:
  bool local_ = false;
  double localRadius_ = 5.0;
  bool aboveGround_ = false;
  double groundCell_ = 10.0;
};

} // namespace pointfront
