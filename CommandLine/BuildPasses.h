#pragma once

#include "HeightArguments.h"
#include "NormalsArguments.h"
#include "ProjectionPass.h"

#include "pointfront/Points/AttributePass.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

using AttributePasses = std::vector<std::unique_ptr<AttributePass>>;

/// The options of `pointfront build` that compute something between the inputs and the tree, and
/// the passes they ask for, in the order in which they must run: coordinates first, then what comes
/// from images, then what comes from neighbours.
class BuildPasses
{
public:
  void declare(CLI::App& app);
  /// Errors  an option that contradicts another.
  Result<AttributePasses> passes() const;

private:
  ProjectionOptions projection_;
  std::vector<std::string> colourFrom_;
  std::vector<std::string> attributeFrom_;
  NormalsArguments normals_;
  HeightArguments heights_;
};

} // namespace pointfront
