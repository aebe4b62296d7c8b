#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace pointfront
{

/// Options and commands of the contract that this version does not carry out. They are recognised,
/// shown in --help as such, and refused (status 2): a flag that does nothing would be a lie.

/// An option with a value (or several) that is refused wherever it is given.
void declareUnavailable(CLI::App& app, const std::string& option, const std::string& why);
/// Likewise without a value.
void declareUnavailableFlag(CLI::App& app, const std::string& flag, const std::string& why);

/// Check for an option of which only some values work: the `available` ones pass; the `planned`
/// ones are refused as not available, all others as unknown.
CLI::Validator availableValues(
  std::vector<std::string> available, std::vector<std::string> planned);

} // namespace pointfront
