#include "Unavailable.h"

#include <algorithm>

namespace pointfront
{

namespace
{
const char* const inThisVersion = " is not available in this version: ";

std::string joined(const std::vector<std::string>& words)
{
  std::string text;
  for (const std::string& word : words)
  {
    text += text.empty() ? word : ", " + word;
  }
  return text;
}

bool has(const std::vector<std::string>& words, const std::string& word)
{
  return std::find(words.begin(), words.end(), word) != words.end();
}

CLI::ParseError refusal(const std::string& name, const std::string& why)
{
  return CLI::ParseError(name + inThisVersion + why, 2);
}
} // namespace

void declareUnavailable(CLI::App& app, const std::string& option, const std::string& why)
{
  const CLI::callback_t refuse = [option, why](const CLI::results_t&) -> bool
  { throw refusal(option, why); };
  app.add_option(option, refuse, "(not available yet)")
    ->expected(1, -1)
    ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
}

void declareUnavailableFlag(CLI::App& app, const std::string& flag, const std::string& why)
{
  app.add_flag_callback(
    flag, [flag, why]() { throw refusal(flag, why); }, "(not available yet)");
}

CLI::Validator availableValues(std::vector<std::string> available, std::vector<std::string> planned)
{
  const std::string shown = joined(available);
  auto check = [available, planned, shown](std::string& value) -> std::string
  {
    if (has(available, value))
    {
      return {};
    }
    return has(planned, value) ? "'" + value + "'" + inThisVersion + "use " + shown
                               : "'" + value + "' is unknown: use " + shown;
  };
  return CLI::Validator(std::move(check), "{" + shown + "}");
}

} // namespace pointfront
