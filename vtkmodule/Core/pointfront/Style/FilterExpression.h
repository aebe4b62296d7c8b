#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Store/StoredCloud.h"
#include "pointfront/Style/PointFilter.h"

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace pointfront
{

/// One condition as the user wrote it, before any store is known.
struct FilterTerm
{
  std::string name; ///< attribute, component or coordinate
  std::size_t position = 0; ///< offset of the name in the text, bytes
  AttributeCondition passing; ///< column, component and axis are not set
};

/// A condition on the points that are drawn, by names: the text of `--where` and of a style's
/// "where".
///
///     where     = condition { "and" condition }
///     condition = name "in" range | name ["not"] "in" set | name comparison number
///     range     = ("[" | "(") number "," number ("]" | ")")       "(" and ")" leave the end out
///     set       = "{" number { "," number } "}"
///     comparison = "==" | "!=" | "<" | "<=" | ">" | ">="
///
/// Names    of attributes without regard to case, "-" for "_"; a component as rgb[0] or normal.z;
///          x, y, z and elevation are coordinates unless the store has an attribute of that name;
///          likewise horizontality and global_height are derived (PointColouring.h).
///          Names with spaces stand in "double quotes", and so do those called and or in.
/// Units    world values: after the attribute's scale and offset, metres of the store's system.
/// Numbers  as in C, without regard to the locale; inf and -inf too. NaN never passes. Whole
///          numbers of 64 bits are taken exactly (AttributeCondition); a fraction is refused where
///          doubles have none, from 2^52 on.
/// Threads  a value.
struct FilterExpression
{
  std::string text; ///< as it was written; empty: all points pass
  std::vector<FilterTerm> terms;

  bool empty() const { return terms.empty(); }
  /// Whether resolve() needs ClassHeights of this store.
  bool wantsHeights(const StoreDescription& store) const;
  /// BadArgument: what is wrong, and where in the text. An empty text lets all points pass.
  static Result<FilterExpression> parse(std::string_view text);
  /// The filter with the columns of a store; BadArgument names an attribute that the store lacks.
  /// `heights` are needed if wantsHeights() is true.
  Result<PointFilter> resolve(const StoreDescription& store,
    const std::shared_ptr<const ClassHeights>& heights = nullptr) const;

  friend bool operator==(const FilterExpression& a, const FilterExpression& b)
  {
    return a.text == b.text;
  }
};

} // namespace pointfront
