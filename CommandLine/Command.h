#pragma once

#include "pointfront/Base/Result.h"

#include <CLI/CLI.hpp>

#include <string>

namespace pointfront
{

/// A command's answer to the shell. The numbers are part of the contract with scripts.
enum ExitStatus : int
{
  Done = 0,
  Failed = 1, ///< the operation failed: one line on stderr says what, where, what to try
  WrongUsage = 2, ///< unknown or contradictory option: nothing was begun
  Interrupted = 130 ///< cancelled by SIGINT, SIGTERM or SIGHUP; nothing is left behind
};

/// One word after `pointfront`: declares its options, then runs once.
/// Errors   what is wrong with the command line itself is thrown while parsing as CLI::ParseError
///          (status 2); what fails later is an Error (status 1, or 130 when it is Cancelled).
/// Output   only what was asked for goes to stdout; warnings and progress go to stderr.
class Command
{
public:
  virtual ~Command() = default;
  /// Adds the subcommand and its options; they stay bound to this object.
  virtual void declare(CLI::App& program) = 0;
  virtual Result<void> run() = 0;

  /// True after parsing if the user named this command.
  bool chosen() const { return app_ != nullptr && app_->parsed(); }
  std::string name() const { return app_->get_name(); }

protected:
  CLI::App* app_ = nullptr;
};

/// One line on stderr: "pointfront COMMAND: TEXT". Line breaks in the text become spaces,
/// other control characters '_'.
void complain(const std::string& command, const std::string& text);
/// Likewise, as "pointfront COMMAND: warning: TEXT".
void warn(const std::string& command, const std::string& text);

} // namespace pointfront
