#pragma once

#include "pointfront/Export/OutputTarget.h"
#include "pointfront/Points/PointSink.h"

#include <CLI/CLI.hpp>

#include <memory>
#include <string>

namespace pointfront
{

/// The kinds of point files that this program writes, named by their extension.

/// What writes a file of that name; the extension has passed the check.
std::unique_ptr<PointSink> makeSink(const std::string& path);
/// What such a file is, for checkOutputTarget().
FileKind sinkKind(const std::string& path);
/// Check for an option that names such a file.
CLI::Validator sinkExtension();

} // namespace pointfront
