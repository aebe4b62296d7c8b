#pragma once

#include "pointfront/Base/Progress.h"
#include "pointfront/Export/OutputTarget.h"
#include "pointfront/Points/PointSink.h"

#include <CLI/CLI.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

namespace pointfront
{

/// The kinds of point files that this program writes, named by their extension.

/// SinkChoice::memoryBytes where the user names none.
std::uint64_t usualCOPCMemoryBytes();

/// The choices that a user has for a file that is written.
struct SinkChoice
{
  bool doubleCoordinates = false; ///< PCD
  /// 8 or 16, of colours that have 16; nothing: 8 in PLY and PCD, whose readers know no more.
  std::optional<unsigned> colourBits;
  bool dated = true; ///< LAS: its header tells the day
  std::string crs; ///< the system to transform into; empty: as they are
  std::uint64_t memoryBytes = usualCOPCMemoryBytes(); ///< COPC: for points
  std::uint64_t readBytes = 0; ///< COPC: of it, what the reading of points needs
  std::string temporaryFolder; ///< COPC: for more points than that; empty: the file's own
  ProgressFunction progress = {}; ///< COPC: of its end, which is half of the work
};

/// Makes the writer of a file of that name; the extension has passed the check.
/// Errors   Unsupported: another system, in a build without PROJ.
Result<std::unique_ptr<PointSink>> makeSink(const std::string& path, const SinkChoice& choice);
/// The kind of such a file, for checkOutputTarget().
FileKind sinkKind(const std::string& path);
/// Whether a name ends in .copc.laz, in any case of its letters.
bool isCOPCName(const std::string& path);
/// Check for an option that names such a file.
CLI::Validator sinkExtension();

} // namespace pointfront
