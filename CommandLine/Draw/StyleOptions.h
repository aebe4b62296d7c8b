#pragma once

#include <CLI/CLI.hpp>

namespace pointfront
{

struct DrawingOptions;

/// Adds --style, --quality, --technique, --where and --class-share to a command. When all its
/// options are read, it makes DrawingOptions::style of them and of --color-by, --point-size,
/// --classes and --edl: the file first, and over its default what the options say. What is wrong in
/// the file is wrong usage, with its place in it. Both must outlive the parsing.
void declareStyle(CLI::App& app, DrawingOptions& options);

} // namespace pointfront
