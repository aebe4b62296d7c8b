#pragma once

#include "pointfront/Points/PassChoice.h"

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace pointfront
{

/// The options of `pointfront build` about normals.
class NormalsArguments
{
public:
  void declare(CLI::App& app);
  /// Called when all options are read. Throws CLI::ValidationError for combinations that make no
  /// sense: wrong usage.
  void check() const;
  void fill(PassChoice& choice) const;

private:
  std::string method_ = "none";
  unsigned neighbours_ = 16;
  double radius_ = 0.0;
  double eps_ = 0.0;
  std::string classes_;
  bool curvature_ = false;
  std::vector<const CLI::Option*> ofPCA_; ///< options that say something about PCA only
  const CLI::Option* classesOption_ = nullptr;
};

} // namespace pointfront
