#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace pointfront
{

/// How many letters must be typed, left out, replaced or exchanged with the next to make one word
/// of the other (optimal string alignment).
std::size_t editDistance(const std::string& one, const std::string& other);

/// The known word that was meant by a mistyped one: nearest, at most a third of it wrong, or the
/// only one that begins with it. Capitals and hyphens count as small letters and underscores.
/// Empty if there is none.
std::string nearestName(const std::string& word, const std::vector<std::string>& known);

/// The end of every message about a name that does not exist: "; did you mean 'intensity'?", or
/// nothing if no known name is near.
std::string didYouMean(const std::string& word, const std::vector<std::string>& known);

} // namespace pointfront
