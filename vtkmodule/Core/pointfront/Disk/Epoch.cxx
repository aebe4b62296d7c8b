#include "pointfront/Disk/Epoch.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>
#include <optional>

namespace pointfront
{
namespace
{
const std::string mark = "#epoch=";

bool isLeap(int year)
{
  return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
}

std::optional<double> yearOf(const std::string& date)
{
  int year = 0;
  int month = 0;
  int day = 0;
  std::string shape = date;
  std::replace_if(
    shape.begin(), shape.end(), [](char c) { return c >= '0' && c <= '9'; }, '0');
  const bool hasDay = shape == "0000-00-00";
  if (!hasDay && shape != "0000-00" && shape != "0000")
  {
    return std::nullopt;
  }
  if (std::sscanf(date.c_str(), "%d-%d-%d", &year, &month, &day) == 1)
  {
    return year;
  }
  std::array<int, 12> days{ 31, isLeap(year) ? 29 : 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31 };
  if (month < 1 || month > 12 || (hasDay && (day < 1 || day > days[month - 1])))
  {
    return std::nullopt;
  }
  if (!hasDay)
  {
    return year + (month - 1) / 12.0;
  }
  int before = day - 1;
  for (int m = 0; m < month - 1; ++m)
  {
    before += days[m];
  }
  return year + before / (isLeap(year) ? 366.0 : 365.0);
}
} // namespace

EpochAddress EpochAddress::of(const std::string& address)
{
  const std::size_t at = address.rfind(mark);
  std::error_code failure;
  if (at == std::string::npos || std::filesystem::exists(address, failure))
  {
    return { address, std::nullopt };
  }
  return { address.substr(0, at), address.substr(at + mark.size()) };
}

std::string EpochAddress::text() const
{
  return epoch ? file + mark + *epoch : file;
}

std::vector<EpochTime> timesOf(const std::vector<std::string>& epochs)
{
  std::vector<EpochTime> times;
  bool dates = true;
  for (const std::string& epoch : epochs)
  {
    const std::optional<double> year = yearOf(epoch);
    dates = dates && year;
    times.push_back({ year.value_or(0.0), epoch });
  }
  std::stable_sort(times.begin(), times.end(),
    [dates](const EpochTime& a, const EpochTime& b) { return dates && a.time < b.time; });
  const auto atOneTime = std::adjacent_find(times.begin(), times.end(),
    [](const EpochTime& a, const EpochTime& b) { return a.time == b.time; });
  if (!dates || atOneTime != times.end())
  {
    for (std::size_t i = 0; i < times.size(); ++i)
    {
      times[i].time = static_cast<double>(i);
    }
  }
  return times;
}

} // namespace pointfront
