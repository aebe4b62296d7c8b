#pragma once

#include "pointfront/Disk/ByteTraffic.h"

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>

#include <string>

namespace pointfront
{

/// Adds --cache-size and --offline to a command that reads clouds by their address. They take the
/// place of POINTFRONT_CACHE_SIZE and POINTFRONT_OFFLINE, for this process and its children.
void declareFarOptions(CLI::App& command);

/// Adds to the statistics what came from servers, or what this process has had so far: requests,
/// bytes_fetched, retries, cache_hits and cache_bytes. All are 0 for files.
void addTraffic(nlohmann::ordered_json& statistics);
void addTraffic(nlohmann::ordered_json& statistics, const TrafficCounts& traffic);
/// A line of `info` for people.
std::string trafficText(const TrafficCounts& traffic);

} // namespace pointfront
