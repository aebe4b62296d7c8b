#include "KnownWords.h"

#include "pointfront/Base/NearestName.h"

#include <algorithm>

namespace pointfront
{

CLI::Validator knownWords(const std::vector<std::string>& words)
{
  std::string shown;
  for (const std::string& word : words)
  {
    shown += shown.empty() ? word : ", " + word;
  }
  auto check = [words, shown](std::string& value) -> std::string
  {
    return std::find(words.begin(), words.end(), value) != words.end()
      ? std::string()
      : "'" + value + "' is unknown: use " + shown + didYouMean(value, words);
  };
  return CLI::Validator(std::move(check), "{" + shown + "}");
}

} // namespace pointfront
