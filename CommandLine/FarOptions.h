#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

namespace pointfront
{

/// Adds --cache-size and --offline to a command that reads clouds by their address. They take the
/// place of POINTFRONT_CACHE_SIZE and POINTFRONT_OFFLINE, for this process and its children.
void declareFarOptions(CLI::App& command);

/// Adds to the statistics what this process has had from servers: requests, bytes_fetched, retries
/// and cache_hits. All are 0 for files.
void addTraffic(nlohmann::ordered_json& statistics);

} // namespace pointfront
