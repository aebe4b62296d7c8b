#include "InputFaults.h"

#include "KnownWords.h"

namespace pointfront
{

void addOnError(CLI::App& app, OnFault& onFault, bool* stopAtCut)
{
  const auto parse = [&onFault, stopAtCut](const CLI::results_t& words)
  {
    onFault = words.back() == "skip" ? OnFault::Skip : OnFault::Stop;
    if (stopAtCut)
    {
      *stopAtCut = onFault == OnFault::Stop;
    }
    return true;
  };
  app.add_option("--on-error", parse, "Of inputs that cannot be used: stop, or skip them (stop)")
    ->type_name("TEXT")
    ->expected(1)
    ->check(knownWords({ "stop", "skip" }));
}

std::string skippedText(const std::vector<InputFault>& skipped)
{
  std::string text;
  for (const InputFault& fault : skipped)
  {
    text += (text.empty() ? "" : ", ") + fault.path + " (" + fault.why + ")";
  }
  const std::string count = std::to_string(skipped.size());
  return text.empty() ? text
                      : "; skipped " + count + (count == "1" ? " input: " : " inputs: ") + text;
}

nlohmann::ordered_json skippedJson(const std::vector<InputFault>& skipped)
{
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const InputFault& fault : skipped)
  {
    list.push_back({ { "path", fault.path }, { "why", fault.why } });
  }
  return list;
}

} // namespace pointfront
