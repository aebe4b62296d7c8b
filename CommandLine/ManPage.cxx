#include "ManPage.h"

namespace pointfront
{
namespace
{
/// Text as roff shows it: a minus stays one, and no line is taken for a request.
std::string roff(const std::string& text)
{
  std::string escaped;
  for (const char c : text)
  {
    switch (c)
    {
      case '\\':
        escaped += "\\e";
        break;
      case '-':
        escaped += "\\-";
        break;
      case '.':
      case '\'':
        escaped += "\\&";
        escaped += c;
        break;
      case '\n':
        escaped += "\n.br\n";
        break;
      default:
        escaped += c;
    }
  }
  return escaped;
}

/// "--bins N", "inputs FILE...".
std::string termOf(const CLI::Option& option)
{
  std::string names;
  if (option.get_positional())
  {
    names = option.get_name(true, false);
  }
  for (const std::string& name : option.get_snames())
  {
    names += (names.empty() ? "-" : ", -") + name;
  }
  for (const std::string& name : option.get_lnames())
  {
    names += (names.empty() ? "--" : ", --") + name;
  }
  std::string term = "\\fB" + roff(names) + "\\fR";
  if (option.get_items_expected_max() > 0 && !option.get_type_name().empty())
  {
    term += " \\fI" + roff(option.get_type_name()) + "\\fR";
  }
  return term;
}

std::string optionsOf(const CLI::App& app)
{
  std::string text;
  for (const CLI::Option* option : app.get_options())
  {
    if (option->get_group().empty()) // hidden
    {
      continue;
    }
    text += ".TP\n" + termOf(*option) + "\n";
    text += roff(option->get_description()) + "\n";
  }
  return text;
}

/// "pointfront info [OPTIONS] inputs..."
std::string synopsisOf(const CLI::App& command, const std::string& program)
{
  std::string line = "\\fB" + program + " " + roff(command.get_name()) + "\\fR [\\fIOPTIONS\\fR]";
  for (const CLI::Option* option : command.get_options())
  {
    if (option->get_positional())
    {
      const bool many = option->get_items_expected_max() > 1;
      line += " \\fI" + roff(option->get_name(true, false)) + "\\fR" + (many ? "\\&..." : "");
    }
  }
  return line;
}
} // namespace

std::string manPage(const CLI::App& program, const std::string& version)
{
  const std::string name = program.get_name();
  std::string synopsis;
  std::string commands;
  for (const CLI::App* command : program.get_subcommands({}))
  {
    synopsis += synopsisOf(*command, name) + "\n.br\n";
    commands += ".SS " + roff(command->get_name()) + "\n" + roff(command->get_description()) + "\n";
    commands += optionsOf(*command);
    if (const std::string footer = command->get_footer(); !footer.empty())
    {
      commands += ".PP\n.nf\n" + roff(footer) + "\n.fi\n";
    }
  }
  return ".TH POINTFRONT 1 \"\" \"" + name + " " + version + "\" \"User Commands\"\n" +
    ".SH NAME\n" + name + " \\- " + roff(program.get_description()) + "\n" + //
    ".SH SYNOPSIS\n.nh\n.ad l\n" + synopsis + "\\fB" + name +
    "\\fR [\\fB\\-\\-help\\fR|\\fB\\-\\-version\\fR]\n.ad b\n.hy\n" + //
    ".SH OPTIONS\n" + optionsOf(program) + //
    ".SH COMMANDS\n" + commands + //
    ".SH \"EXIT STATUS\"\n"
    ".TP\n\\fB0\\fR\nthe command is done\n"
    ".TP\n\\fB1\\fR\nit failed: one line on standard error says what, where, and what to try\n"
    ".TP\n\\fB2\\fR\nwrong usage: nothing was begun\n"
    ".TP\n\\fB130\\fR\ninterrupted: nothing is left behind\n";
}

} // namespace pointfront
