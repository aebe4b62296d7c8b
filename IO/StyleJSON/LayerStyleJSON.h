#pragma once

#include "JSONPlace.h"

#include "pointfront/Style/StyleSheet.h"

#include <string>
#include <utility>
#include <vector>

namespace pointfront
{

// Parts of a style sheet, read from their place in it. All throw JSONRefusal.

/// One of some words.
template <typename T>
T oneOf(const JSONPlace& place, const std::vector<std::pair<const char*, T>>& words)
{
  std::string list;
  std::vector<std::string> known;
  const std::string text = place.text("a word");
  for (const auto& [word, value] : words)
  {
    if (text == word)
    {
      return value;
    }
    list += (list.empty() ? "" : ", ") + std::string(word);
    known.emplace_back(word);
  }
  place.refuse("'" + text + "' is unknown: use " + list + didYouMean(text, known));
}

Rgba8 colourCodeAt(const JSONPlace& place);
/// A condition on attributes.
FilterExpression filterAt(const JSONPlace& place);
/// `text`: a class code as a key has it.
std::uint8_t classCode(const JSONPlace& place, const std::string& text);
LayerStyle layerStyleAt(const JSONPlace& place);
std::vector<StyleLens> lensesAt(const JSONPlace& place);
std::vector<StyleHighlight> highlightsAt(const JSONPlace& place);

} // namespace pointfront
