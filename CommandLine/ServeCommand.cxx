#include "ServeCommand.h"

#include "CloudFormats.h"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include <sys/wait.h>
#include <unistd.h>

namespace pointfront
{
namespace
{

constexpr int noInterpreter = 127;

std::vector<char*> wordsFor(std::vector<std::string>& texts)
{
  std::vector<char*> words;
  for (std::string& text : texts)
  {
    words.push_back(text.data());
  }
  words.push_back(nullptr);
  return words;
}

/// The status that it ends with; noInterpreter also where it cannot be started.
int statusOf(std::vector<std::string> command)
{
  const std::vector<char*> words = wordsFor(command);
  const pid_t child = fork();
  if (child == 0)
  {
    execvp(words[0], words.data());
    _exit(noInterpreter);
  }
  int status = 0;
  const bool ended = child > 0 && waitpid(child, &status, 0) == child;
  return ended && WIFEXITED(status) ? WEXITSTATUS(status) : noInterpreter;
}

} // namespace

void ServeCommand::declare(CLI::App& program)
{
  app_ = program.add_subcommand(
    "serve", "Show stores in a browser: the page of the Python package (serve --help)");
  app_->set_help_flag(); // the page's own
  app_->prefix_command();
}

Result<void> ServeCommand::run()
{
  const char* const named = std::getenv("POINTFRONT_PYTHON");
  const std::string python = named != nullptr && *named != '\0' ? named : "python3";
  const int status = statusOf({ python, "-c",
    "import importlib.util, sys; sys.exit(importlib.util.find_spec('pointfront') is None)" });
  if (status != 0)
  {
    return makeError(Error::Kind::Unsupported,
      status == noInterpreter
        ? "the page is drawn by Python, and there is no " + python +
          "; install it, or name one in POINTFRONT_PYTHON"
        : "the page belongs to the Python package pointfront, which " + python +
          " has not; install it there (docs/user/python.md), or name another interpreter in "
          "POINTFRONT_PYTHON");
  }
  std::vector<std::string> command{ python, "-m", "pointfront", "serve" };
  const std::vector<std::string> further = app_->remaining();
  command.insert(command.end(), further.begin(), further.end());
  if (const std::string far = credentialsForChild(further); !far.empty())
  {
    ::setenv("POINTFRONT_FAR", far.c_str(), 1);
  }
  const std::vector<char*> words = wordsFor(command);
  execvp(words[0], words.data());
  return makeError(
    Error::Kind::Unsupported, python + " cannot be started: " + std::strerror(errno));
}

} // namespace pointfront
