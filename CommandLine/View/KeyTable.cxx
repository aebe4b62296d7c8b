#include "KeyTable.h"

#include <algorithm>
#include <utility>

namespace pointfront
{

namespace
{
/// Keysyms that differ from what the table shows.
constexpr std::array<std::pair<std::string_view, std::string_view>, 10> keysyms{ {
  { "question", "?" },
  { "slash", "?" }, // where a VTK names a key as if Shift was not held
  { "F1", "?" },
  { "plus", "+" },
  { "equal", "+" }, // likewise
  { "minus", "-" },
  { "KP_Add", "+" },
  { "KP_Subtract", "-" },
  { "KP_Enter", "Return" },
  { "space", "Return" },
} };

template <typename Table>
void appendLines(const Table& table, std::string& text)
{
  constexpr std::size_t column = 13;
  for (const KeyBinding& binding : table)
  {
    std::string key = binding.key;
    key.resize(std::max(column, key.size()), ' ');
    text += key + binding.what + "\n";
  }
}
} // namespace

KeyAction keyActionOf(std::string_view keysym)
{
  for (const auto& [symbol, key] : keysyms)
  {
    keysym = keysym == symbol ? key : keysym;
  }
  const auto found = std::find_if(keyTable.begin(), keyTable.end(),
    [keysym](const KeyBinding& binding) { return keysym == binding.key; });
  return found == keyTable.end() ? KeyAction::None : found->action;
}

std::string keyHelp()
{
  std::string text;
  appendLines(mouseTable, text);
  appendLines(keyTable, text);
  return text;
}

} // namespace pointfront
