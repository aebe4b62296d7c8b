#pragma once

#include "pointfront/Points/AttributeSchema.h"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace pointfront
{

/// A component of a store's attribute.
struct AttributeComponent
{
  std::uint32_t column = 0;
  std::optional<int> component; ///< as the name says; nothing: it names the attribute as a whole
};

/// The attribute or component of a store that a user's name means: an attribute's name, exact
/// first, then without regard to case and with "_" for "-"; or such a name with a component behind
/// it: rgb[0], normal.z, rgb.r (x, y, z and r, g, b, a are 0 to 3). Nothing: there is no such
/// attribute or component.
std::optional<AttributeComponent> findComponent(
  const AttributeSchema& schema, std::string_view name);

/// The name with "_" for "-".
std::string withUnderscores(std::string_view name);

} // namespace pointfront
