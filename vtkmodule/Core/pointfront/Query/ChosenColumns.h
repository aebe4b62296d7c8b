#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Store/NodeReader.h"
#include "pointfront/Store/StoredCloud.h"

#include <optional>
#include <string>
#include <vector>

namespace pointfront
{

/// Attributes that come with points: columns of the store, and its description with only these.
struct ChosenColumns
{
  ColumnSelection columns;
  StoreDescription description;

  /// The attributes with these names in the store's order, each once; nothing: all that the cloud
  /// holds, without what is computed while it loads. BadArgument names an attribute that the store
  /// lacks.
  static Result<ChosenColumns> make(
    const StoreDescription& store, const std::optional<std::vector<std::string>>& names);
  /// All that it holds but the enclosing radius of representatives, which points of the input have
  /// not.
  static ChosenColumns ofInput(const StoreDescription& store);
};

} // namespace pointfront
