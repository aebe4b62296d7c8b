#include "OwnFiles.h"

#include <algorithm>
#include <filesystem>

namespace pointfront
{
namespace
{
namespace fs = std::filesystem;

bool begins(std::string_view text, std::string_view with)
{
  return text.substr(0, with.size()) == with;
}

/// Takes a beginning off. False: the text has another.
bool take(std::string_view& text, std::string_view beginning)
{
  const bool has = begins(text, beginning);
  text.remove_prefix(has ? beginning.size() : 0);
  return has;
}

/// Takes characters of a set off. The number of them.
std::size_t takeAll(std::string_view& text, std::string_view characters)
{
  const std::size_t count = std::min(text.find_first_not_of(characters), text.size());
  text.remove_prefix(count);
  return count;
}

bool takeNumber(std::string_view& text)
{
  return takeAll(text, "0123456789") > 0;
}

/// The column and the row of a tile.
bool takeIndex(std::string_view& text)
{
  take(text, "-");
  if (!takeNumber(text) || !take(text, "_"))
  {
    return false;
  }
  take(text, "-");
  return takeNumber(text);
}

bool takeHexadecimal(std::string_view& text, std::size_t digits)
{
  return takeAll(text, "0123456789abcdef") == digits;
}

/// Nothing, or the mark of a TemporaryFile.
bool isTemporaryEnd(std::string_view end)
{
  if (end.empty())
  {
    return true;
  }
  std::string_view first = end; // the name before it is known which file it is
  const bool early = take(first, ".") && takeHexadecimal(first, 16) && first == ".tmp";
  return early ||
    (take(end, ".") && takeHexadecimal(end, 16) && take(end, "-") && takeHexadecimal(end, 16) &&
      end == ".tmp");
}

/// Nothing, or the name of a process that is writing (processName()).
bool isProcessEnd(std::string_view end)
{
  if (end.empty())
  {
    return true;
  }
  const std::size_t dash = end.rfind('-');
  std::string_view process = dash == std::string_view::npos ? "" : end.substr(dash + 1);
  return end.front() == '.' && takeNumber(process) && process.empty();
}
} // namespace

bool isNameOfTile(std::string_view name)
{
  if (!takeIndex(name))
  {
    return false;
  }
  if (take(name, "-"))
  {
    return takeHexadecimal(name, 8) && name == ".pfront";
  }
  constexpr std::string_view part = ".part.pfront";
  const std::size_t at = name.rfind(part);
  return at != std::string_view::npos && at > 0 && isProcessEnd(name.substr(0, at)) &&
    isTemporaryEnd(name.substr(at + part.size()));
}

bool isNameOfRecord(std::string_view name)
{
  return take(name, "tile-") && takeIndex(name) && take(name, ".json") && isProcessEnd(name);
}

bool isNameOfPoints(std::string_view name)
{
  return take(name, "points-") && takeNumber(name) && take(name, ".kept") && isTemporaryEnd(name);
}

std::string foreignEntry(const std::string& folder)
{
  std::error_code failure;
  for (const auto& entry : fs::directory_iterator(folder, failure))
  {
    const std::string name = entry.path().filename().string();
    // Whose tiles a link leads to is not known.
    if ((name != "tiles" && name != "work") || !fs::is_directory(entry.symlink_status(failure)))
    {
      return name;
    }
    for (const auto& inner : fs::directory_iterator(entry.path(), failure))
    {
      const std::string inside = inner.path().filename().string();
      // Runs of several processes log, and a kill may come while the plan is written.
      const bool early = name == "work" &&
        (inside == "logs" || begins(inside, "stop-") || begins(inside, "plan.json"));
      if (!early)
      {
        return name + "/" + inside;
      }
    }
  }
  return "";
}

} // namespace pointfront
