#include "Program.h"

#include "BenchCommand.h"
#include "BuildCommand.h"
#include "CacheCommand.h"
#include "CollectionCommand.h"
#include "CompareCommand.h"
#include "ExportCommand.h"
#include "FarOptions.h"
#include "GenerateCommand.h"
#include "IndexCommand.h"
#include "InfoCommand.h"
#include "ManPage.h"
#include "RenderCommand.h"
#include "ServeCommand.h"
#include "StreamCommand.h"
#include "VerifyCommand.h"
#include "ViewCommand.h"

#include "CloudFormats.h"
#include "LeftOut.h"

#include "pointfront/Base/NearestName.h"
#include "pointfront/Disk/ByteOpeners.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>

namespace pointfront
{
namespace
{
std::string versionText()
{
  std::string text = "pointfront " POINTFRONT_VERSION;
  for (const LeftOutFamily& family : leftOutFamilies())
  {
    text += "\nbuilt without " + family.name + " (" + family.option + ")";
  }
  return text;
}

/// An address for which an option takes what it writes: a path of that text would be a folder
/// "s3:", in which all went well. Empty: there is none.
std::string addressAsOutput(const CLI::App& command)
{
  for (const char* const name : { "--output", "--stats", "--picture", "--frames-csv", "--store" })
  {
    const CLI::Option* const option = command.get_option_no_throw(name);
    const std::string value =
      option != nullptr && option->count() > 0 ? option->results().back() : std::string();
    if (isAddress(value))
    {
      const bool tiles = command.get_name() == "build" && command.count("--tiles") > 0;
      return std::string(name) + ": '" + value + "' is an address, and this writes files of this " +
        "machine only; " +
        (tiles ? "tiles are built into a bucket by python3 -m pointfront cluster build"
               : "write a file and upload that");
    }
  }
  for (const CLI::App* below : command.get_subcommands())
  {
    if (std::string told = addressAsOutput(*below); !told.empty())
    {
      return told;
    }
  }
  return {};
}

/// All printed text has arrived: a full disk behind stdout is known here at the latest.
Result<void> flushedOutput()
{
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
  {
    return makeError(Error::Kind::Unwritable,
      std::string("cannot write to the standard output: ") + std::strerror(errno));
  }
  return {};
}

/// The last resort: memory runs out, or a library throws, where nothing more can be said.
Result<void> runGuarded(Command& command)
{
  try
  {
    Result<void> outcome = command.run();
    return outcome ? flushedOutput() : outcome;
  }
  catch (const std::bad_alloc&)
  {
    return makeError(Error::Kind::NoMemory,
      "out of memory; close other programs, raise the limit, or ask for less (--memory, --size)");
  }
  catch (const std::exception& problem)
  {
    return makeError(Error::Kind::Unreadable, std::string("unexpected: ") + problem.what());
  }
}
} // namespace

Program::Program()
  : app_("Point clouds larger than memory: build stores, check them, draw them.", "pointfront")
{
  app_.set_version_flag("--version", versionText);
  commands_.push_back(std::make_unique<BuildCommand>());
  addCloudFormats();
  commands_.push_back(std::make_unique<IndexCommand>());
  commands_.push_back(std::make_unique<InfoCommand>());
  commands_.push_back(std::make_unique<VerifyCommand>());
  commands_.push_back(std::make_unique<ExportCommand>());
  commands_.push_back(std::make_unique<GenerateCommand>());
  commands_.push_back(std::make_unique<RenderCommand>());
  commands_.push_back(std::make_unique<BenchCommand>());
  commands_.push_back(std::make_unique<CompareCommand>());
  commands_.push_back(std::make_unique<ViewCommand>());
  commands_.push_back(std::make_unique<ServeCommand>());
  commands_.push_back(std::make_unique<StreamCommand>());
  commands_.push_back(std::make_unique<CacheCommand>());
  commands_.push_back(std::make_unique<CollectionCommand>());
  for (const auto& command : commands_)
  {
    command->declare(app_);
  }
  for (const char* const reader :
    { "build", "info", "verify", "export", "render", "bench", "view", "stream", "collection" })
  {
    declareFarOptions(*app_.get_subcommand(reader));
  }
}

std::string Program::commandNamed(int argc, char** argv) const
{
  for (int i = 1; i < argc; ++i)
  {
    const std::string word = argv[i];
    const auto isWord = [&word](const CLI::App* command) { return command->get_name() == word; };
    if (!app_.get_subcommands(isWord).empty())
    {
      return word;
    }
  }
  return {};
}

std::string Program::commandsText(int argc, char** argv) const
{
  std::vector<std::string> known;
  for (const auto& command : commands_)
  {
    known.push_back(command->name());
  }
  if (const std::string meant = argc > 1 ? didYouMean(argv[1], known) : ""; !meant.empty())
  {
    return std::string("there is no command '") + argv[1] + "'" + meant;
  }
  std::string names;
  for (const auto& command : commands_)
  {
    names += (names.empty() ? "" : ", ") + command->name();
  }
  return "the first word is a command: " + names + " (COMMAND --help tells more)";
}

std::string Program::usageText(const std::string& command, const CLI::ParseError& wrong) const
{
  constexpr std::size_t longest = 500;
  if (std::string told = optionAsValue(app_); !told.empty())
  {
    return told;
  }
  std::string text = wrong.what();
  std::vector<std::string> known;
  const CLI::App* const app = app_.get_subcommand(command);
  for (const CLI::Option* option : app->get_options())
  {
    for (const std::string& name : option->get_lnames())
    {
      known.push_back("--" + name);
    }
  }
  for (const std::string& word : app->remaining())
  {
    const std::string name = word.substr(0, word.find('='));
    if (const std::string meant = didYouMean(name, known); name[0] == '-' && !meant.empty())
    {
      return "there is no option '" + name + "'" + meant;
    }
  }
  return text.size() > longest ? text.substr(0, longest) + "..." : text;
}

/// CLI11 takes the next word for a value, whatever it is: "--stats --edl" would write a file that
/// is called --edl, and draw without. Empty: no option is taken for a value.
std::string Program::optionAsValue(const CLI::App& command) const
{
  for (const CLI::Option* option : command.get_options())
  {
    for (const std::string& value : option->results())
    {
      if (value.size() > 1 && value[0] == '-' && command.get_option_no_throw(value) != nullptr)
      {
        return option->get_name() + " lacks its value: behind it stands " + value +
          ", which is an option (a file of that name is ./" + value + ")";
      }
    }
  }
  for (const CLI::App* below : command.get_subcommands())
  {
    if (std::string told = optionAsValue(*below); !told.empty())
    {
      return told;
    }
  }
  return {};
}

int Program::run(int argc, char** words)
{
  // No command sees what is secret in an address, so that none can tell it.
  std::vector<std::string> named;
  for (int i = 0; i < argc; ++i)
  {
    named.push_back(publicForm(words[i]));
  }
  std::vector<char*> pointers;
  for (std::string& word : named)
  {
    pointers.push_back(word.data());
  }
  pointers.push_back(nullptr);
  char** const argv = pointers.data();
  if (argc == 2 && std::strcmp(argv[1], "--help-man") == 0)
  {
    const std::string page = manPage(app_, POINTFRONT_VERSION);
    const bool whole = std::fwrite(page.data(), 1, page.size(), stdout) == page.size();
    return whole && std::fflush(stdout) == 0 ? ExitStatus::Done : ExitStatus::Failed;
  }
  try
  {
    app_.parse(argc, argv);
    const std::string lacking = optionAsValue(app_);
    if (const std::string told = lacking.empty() ? addressAsOutput(app_) : lacking; !told.empty())
    {
      throw CLI::ValidationError(told);
    }
  }
  catch (const CLI::Success& help) // --help, --version
  {
    return app_.exit(help);
  }
  catch (const CLI::ParseError& wrong)
  {
    const std::string command = commandNamed(argc, argv);
    complain(command, command.empty() ? commandsText(argc, argv) : usageText(command, wrong));
    return ExitStatus::WrongUsage;
  }
  for (const auto& command : commands_)
  {
    if (!command->chosen())
    {
      continue;
    }
    const Result<void> outcome = runGuarded(*command);
    if (outcome)
    {
      return ExitStatus::Done;
    }
    complain(command->name(), outcome.error().what);
    return outcome.error().kind == Error::Kind::Cancelled ? ExitStatus::Interrupted
                                                          : ExitStatus::Failed;
  }
  complain("", commandsText(argc, argv));
  return ExitStatus::WrongUsage;
}

} // namespace pointfront
