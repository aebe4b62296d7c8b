#include "Command.h"

#include "pointfront/Base/PrintableText.h"

#include <cstdio>

namespace pointfront
{

namespace
{
/// The text may quote a file: what a terminal obeys is not printed.
void printLine(const std::string& prefix, const std::string& text)
{
  std::fprintf(stderr, "%s: %s\n", prefix.c_str(), printableText(text).c_str());
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
