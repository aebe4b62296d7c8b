#pragma once

#include <string>
#include <string_view>

namespace pointfront
{

// Others may keep files in the folders of a build of tiles. It removes none that has no name of
// these.

/// Whether a build of tiles names a file in FOLDER/tiles so: a tile, or one in the making.
bool isNameOfTile(std::string_view name);
/// Whether it names a file in FOLDER/work so: the record of a tile, or one in the making.
bool isNameOfRecord(std::string_view name);
/// Whether it names a file in FOLDER/work so: points that are kept, also in the making.
bool isNameOfPoints(std::string_view name);

/// The name of something in a folder without a plan that no build of tiles makes before its plan;
/// empty: nothing is there.
std::string foreignEntry(const std::string& folder);

} // namespace pointfront
