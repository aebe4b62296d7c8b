#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Build/OpenedInputs.h"

#include <functional>
#include <string>
#include <vector>

namespace pointfront
{

/// The files that the arguments of `build` stand for.
struct InputFileList
{
  std::vector<std::string> paths; ///< sorted bytewise: the same for any order of the arguments
  std::vector<std::string> warnings; ///< a file that was named twice is read once
};

/// Tells points from notes; may be empty.
using PointFileTest = std::function<bool(const std::string&)>;

/// Turns files, glob patterns (*, ?, [...], for programs that call without a shell) and folders
/// (every file below it whose extension is one of `extensions`, lower case without the dot, and
/// that passes `isPointFile`) into a list of files.
/// Errors  NotFound: no such file, a pattern that matches nothing, a folder without a point file;
///         of several each is named. With `faults` they are added there instead.
/// `isStore`  tells stores and indices: of a folder that holds other point files, too, they are
///            left out, with a warning, for they may hold the same points. Empty: all are taken.
Result<InputFileList> findInputFiles(const std::vector<std::string>& arguments,
  const std::vector<std::string>& extensions, const PointFileTest& isPointFile = {},
  std::vector<InputFault>* faults = nullptr, const PointFileTest& isStore = {});

} // namespace pointfront
