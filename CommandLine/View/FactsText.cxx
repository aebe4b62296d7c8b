#include "FactsText.h"

#include <cstdio>

namespace pointfront
{

std::string grouped(std::int64_t number)
{
  std::string digits = std::to_string(number);
  const std::size_t first = number < 0 ? 1 : 0;
  for (std::size_t at = digits.size(); at > first + 3;)
  {
    at -= 3;
    digits.insert(at, ",");
  }
  return digits;
}

std::string factsText(const FrameRecord& frame, bool loading)
{
  char text[160];
  std::snprintf(text, sizeof text, "%.0f ms a frame, %.0f a second\n%s points, error %.2g px%s",
    frame.milliseconds, frame.milliseconds > 0.0 ? 1000.0 / frame.milliseconds : 0.0,
    grouped(frame.points).c_str(), frame.errorPx,
    loading            ? ", loading"
      : frame.complete ? ", complete"
                       : "");
  return text;
}

} // namespace pointfront
