#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Style/StyleSheet.h"

#include <string>
#include <string_view>

namespace pointfront
{

/// A style sheet from the text of docs/user/styles.md.
/// Strict   a key that does not exist or stands there twice, a class that is none, a value of the
///          wrong type or outside its range is an Error of kind BadArgument that begins with its
///          place: "classes.6.size.mode: ...", behind the line where the text has several:
///          "line 4: classes.6...". A name that is nearly right gets the one that was meant.
///          Nothing is ignored.
/// Later    lenses, highlights and techniques that no back end draws are recognised and refused as
///          not available.
Result<StyleSheet> parseStyleSheet(std::string_view json);

/// The text that parseStyleSheet() reads back as an equal sheet; lights are not part of it.
std::string writeStyleSheet(const StyleSheet& sheet);
/// The values of the keys "color" and "size", on one line.
std::string writeColour(const ColourSource& source);
/// Parses the part that `default` or a class has in a sheet.
Result<LayerStyle> parseLayerStyle(std::string_view text);
std::string writeLayerStyle(const LayerStyle& style);
std::string writeSize(const StyleSize& size);

} // namespace pointfront
