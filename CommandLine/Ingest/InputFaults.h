#pragma once

#include "pointfront/Build/OpenedInputs.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace pointfront
{

/// --on-error stop|skip of `build` and `index`. `stopAtCut`, if any: set where the user asks for
/// stop, which then holds for inputs that were cut short too.
void addOnError(CLI::App& app, OnFault& onFault, bool* stopAtCut = nullptr);
/// Behind a summary: "; skipped 2 inputs: a.las (why), b.las (why)". Empty if there are none.
std::string skippedText(const std::vector<InputFault>& skipped);
/// The key `inputs_skipped` of a report: a list of {path, why}.
nlohmann::ordered_json skippedJson(const std::vector<InputFault>& skipped);

} // namespace pointfront
