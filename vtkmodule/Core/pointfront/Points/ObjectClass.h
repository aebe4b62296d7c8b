#pragma once

#include <cstdint>
#include <string>

namespace pointfront
{

/// Name of an ASPRS standard class (LAS 1.4 R15, table 17), lower case: "ground", "building" ...;
/// "class N" for what the standard reserves or leaves to the user.
std::string objectClassName(std::uint8_t objectClass);

/// True for the classes of points that nobody classified: 0 and 1.
inline bool unclassified(std::uint8_t objectClass)
{
  return objectClass <= 1;
}

} // namespace pointfront
