#pragma once

#include <string>
#include <vector>

namespace CLI
{
class App;
}

namespace pointfront
{

/// `--epoch NAME`: the tiles of one epoch of each collection among the clouds, whose addresses get
/// it (EpochAddress). Clouds that are no collections are errors when they are opened.
/// Order  call it after the option that gives the clouds: options are taken in that order.
void declareEpoch(CLI::App& app, std::vector<std::string>& clouds);
void declareEpoch(CLI::App& app, std::string& cloud);

} // namespace pointfront
