#include "Command.h"

#include <algorithm>
#include <cstdio>

namespace pointfront
{

namespace
{
void printLine(const std::string& prefix, std::string text)
{
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::replace(text.begin(), text.end(), '\r', ' ');
  std::fprintf(stderr, "%s: %s\n", prefix.c_str(), text.c_str());
}
} // namespace

void complain(const std::string& command, const std::string& text)
{
  printLine(command.empty() ? "pointfront" : "pointfront " + command, text);
}

void warn(const std::string& command, const std::string& text)
{
  printLine("pointfront " + command + ": warning", text);
}

} // namespace pointfront
