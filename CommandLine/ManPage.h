#pragma once

#include <CLI/CLI.hpp>

#include <string>

namespace pointfront
{

/// The manual page of the program (roff, section 1), from what --help knows: every command, option
/// and value. `version` stands in its foot. It has no date: the same program gives the same bytes.
std::string manPage(const CLI::App& program, const std::string& version);

} // namespace pointfront
