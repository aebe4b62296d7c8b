#pragma once

#include "HeightArguments.h"
#include "NormalsArguments.h"

#include "pointfront/Points/PassChoice.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace pointfront
{

/// The options of `pointfront build` that compute something between the inputs and the tree, and
/// the passes they ask for, in the order in which they must run: coordinates first, then what comes
/// from images, then what comes from neighbours.
class BuildPasses
{
public:
  void declare(CLI::App& app);
  /// Takes what is a point file by its extension back from the options that take all names behind
  /// them: `build --color-from ortho.tif survey.laz` means an image and an input.
  std::vector<std::string> inputsAmongImages(const std::vector<std::string>& pointExtensions);
  PassChoice choice() const;
  /// Errors  those of chosenPasses().
  Result<AttributePasses> passes() const;

private:
  PassChoice choice_; ///< but for what follows
  NormalsArguments normals_;
  HeightArguments heights_;
};

} // namespace pointfront
