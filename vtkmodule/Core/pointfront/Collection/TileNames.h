#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Collection/TileIntake.h"

#include <string>
#include <vector>

namespace pointfront
{

// Checks of what tiles of one collection are called. `path` is the collection's, `kept` are the
// tiles that it has and keeps.

/// Whoever lists tiles line by line sees what they are called.
/// Errors  BadArgument: control characters in a name or an epoch.
Result<void> checkNames(const std::string& path, const std::vector<TileRequest>& requests);

/// A path counts once. A file with several names, by links, counts as often as it is named, as
/// whoever made the links may want: the result is a warning, or empty. `added` are the requests'
/// tiles, in their order.
/// Errors  BadArgument: a path that is named twice, or is a tile already.
Result<std::string> filesApart(const std::string& path, const std::vector<const TileName*>& kept,
  const std::vector<TileRequest>& requests, const std::vector<IncomingTile>& added);

/// Names are unique; a plain name that another tile has becomes the tile's address, unless somebody
/// chose it.
/// Errors  BadArgument: a chosen name that another tile has.
Result<void> nameApart(const std::string& path, const std::vector<const TileName*>& kept,
  std::vector<IncomingTile>& added);

} // namespace pointfront
