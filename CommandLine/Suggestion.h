#pragma once

#include <string>
#include <vector>

namespace pointfront
{

/// How many letters must be typed, left out, replaced or exchanged with the next to make one word
/// of the other (optimal string alignment).
std::size_t editDistance(const std::string& one, const std::string& other);

/// The known word that was meant by a mistyped one: nearest, at most a third of it wrong, or the
/// only one that begins with it. Empty if there is none.
std::string suggestionFor(const std::string& word, const std::vector<std::string>& known);

} // namespace pointfront
