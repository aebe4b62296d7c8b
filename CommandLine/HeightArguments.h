#pragma once

#include "pointfront/Points/AttributePass.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <vector>

namespace pointfront
{

/// The options of `pointfront build` about heights, and the passes they ask for.
class HeightArguments
{
public:
  void declare(CLI::App& app);
  std::vector<std::unique_ptr<AttributePass>> passes() const;

private:
  bool local_ = false;
  double localRadius_ = 5.0;
  bool aboveGround_ = false;
  double groundCell_ = 10.0;
};

} // namespace pointfront
