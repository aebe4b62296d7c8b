#pragma once

#include "BuildOrder.h"

namespace pointfront
{

/// A build as Python asks for it: JSON with the names of pointfront.build(), whose checks it has
/// passed; what is not named has its default. Each code point of its texts, U+0000 to U+00FF, is a
/// byte, so that paths need not be UTF-8. Throws nlohmann's exceptions for what is no such JSON.
BuildOrder buildOrderOf(const char* text);

} // namespace pointfront
