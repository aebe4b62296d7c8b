#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace pointfront
{

/// A check of an option that takes one of these words. It refuses any other one, lists the words,
/// and says which of them was probably meant.
CLI::Validator knownWords(const std::vector<std::string>& words);

} // namespace pointfront
