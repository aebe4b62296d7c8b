#pragma once

#include "Command.h"

#include <memory>
#include <vector>

namespace pointfront
{

/// The tool as a whole: its commands, and what becomes of their errors.
class Program
{
public:
  Program();

  /// Parses, runs the one command that was chosen and gives the exit status.
  int run(int argc, char** argv);

private:
  /// The command that the words name, for messages about the rest of them; may be empty.
  std::string commandNamed(int argc, char** argv) const;

  std::string commandsText(int argc, char** argv) const;
  /// Says why the command line is wrong, and which option may have been meant.
  std::string usageText(const std::string& command, const CLI::ParseError& wrong) const;
  std::string optionAsValue(const CLI::App& command) const;

  CLI::App app_;
  std::vector<std::unique_ptr<Command>> commands_;
};

} // namespace pointfront
