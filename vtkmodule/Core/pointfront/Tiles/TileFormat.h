#pragma once

#include "pointfront/Store/StoredCloud.h"

#include <string>
#include <string_view>
#include <vector>

namespace pointfront
{

/// The stores that a list names, one in a line: paths or patterns (*, ?, [...]), relative to the
/// list's folder. Blank lines and what follows a # at the beginning of a line are left out; a store
/// that is named twice is taken once.
/// Errors  NotFound: nothing is there by a name; BadFormat: a line that is no text; no name at all;
///         those of fileNamedBy().
Result<std::vector<std::string>> readTileList(const std::string& path);
/// The lines that are names, as they stand there. BadFormat: as above.
Result<std::vector<std::string>> parseTileList(std::string_view text, const std::string& path);

/// The stores that a folder stands for: its own; if it has none, its indices; if it has neither,
/// its COPC files. Below it, too; sorted. Previews of builds are left out.
struct TileFolder
{
  std::vector<std::string> files;
  std::vector<std::string> warnings; ///< warnings about other files there

  /// Errors  Unreadable.
  static Result<TileFolder> of(const std::string& folder);
};

/// Opens a list of stores (`.pfronts`), or a folder of them, as one cloud.
class TileFormat final : public StoredCloudFormat
{
public:
  std::string name() const override { return "list or folder of stores"; }
  bool accepts(const std::string& path) const override;
  Result<std::shared_ptr<const StoredCloud>> open(const std::string& path) const override;
};

} // namespace pointfront
