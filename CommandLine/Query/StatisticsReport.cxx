#include "StatisticsReport.h"

#include "CloudFacts.h"

#include "pointfront/Points/ObjectClass.h"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>

namespace pointfront
{

namespace
{
const char* const densityMethod =
  "points divided by the area of the square ground cells that hold one";

std::string numberText(double value)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.12g", value);
  return text;
}

std::string valueText(const std::optional<ExactValue>& value)
{
  if (!value)
  {
    return "-";
  }
  if (const auto* real = std::get_if<double>(&*value))
  {
    return numberText(*real);
  }
  const auto* whole = std::get_if<std::uint64_t>(&*value);
  return whole != nullptr ? std::to_string(*whole) : std::to_string(std::get<std::int64_t>(*value));
}

nlohmann::ordered_json valueJson(const std::optional<ExactValue>& value)
{
  return value ? std::visit([](auto v) { return nlohmann::ordered_json(v); }, *value)
               : nlohmann::ordered_json();
}

std::string fullName(const ComponentName& name)
{
  return name.components > 1 ? name.attribute + '[' + std::to_string(name.component) + ']'
                             : name.attribute;
}

nlohmann::ordered_json componentsJson(
  const PointStatistics& statistics, const GroupStatistics& group)
{
  auto list = nlohmann::ordered_json::array();
  for (std::size_t c = 0; c < group.components.size(); ++c)
  {
    const ComponentStatistics& component = group.components[c];
    // NaN, of no values, becomes null.
    list.push_back({ { "name", statistics.names[c].attribute },
      { "component", statistics.names[c].component }, { "count", component.count },
      { "not_a_number", component.notANumber }, { "infinite", component.infinite },
      { "minimum", valueJson(component.low) }, { "maximum", valueJson(component.high) },
      { "mean", component.moments.mean }, { "standard_deviation", component.moments.deviation },
      { "histogram",
        { { "low", valueJson(statistics.bins[c].low) }, { "width", statistics.bins[c].width },
          { "counts", component.histogram } } } });
  }
  return list;
}

/// A character for each bin, by its share of the fullest one; only an empty bin is blank.
std::string histogramText(const std::vector<std::uint64_t>& counts)
{
  constexpr const char* levels = ".:-=+*#%@";
  constexpr std::uint64_t levelCount = 9;
  const std::uint64_t most = counts.empty() ? 0 : *std::max_element(counts.begin(), counts.end());
  std::string text;
  for (const std::uint64_t count : counts)
  {
    const double share = static_cast<double>(count) / static_cast<double>(std::max(most, count));
    text += count == 0 ? ' '
                       : levels[std::min(levelCount - 1,
                           static_cast<std::uint64_t>(share * static_cast<double>(levelCount)))];
  }
  return text;
}

std::string groupText(const PointStatistics& statistics, const GroupStatistics& group)
{
  std::string text = "\n    attribute                minimum          maximum             mean"
                     "        deviation  histogram";
  for (std::size_t c = 0; c < group.components.size(); ++c)
  {
    const ComponentStatistics& component = group.components[c];
    const bool any = component.count > 0;
    char row[160];
    std::snprintf(row, sizeof row, "\n    %-15s %16s %16s %16s %16s  |",
      fullName(statistics.names[c]).substr(0, 40).c_str(), valueText(component.low).c_str(),
      valueText(component.high).c_str(), any ? numberText(component.moments.mean).c_str() : "-",
      any ? numberText(component.moments.deviation).c_str() : "-");
    text += row + histogramText(component.histogram) + '|';
    if (component.notANumber + component.infinite > 0)
    {
      text += " without " + std::to_string(component.notANumber) + " not a number, " +
        std::to_string(component.infinite) + " infinite";
    }
  }
  return text;
}
} // namespace

nlohmann::ordered_json statisticsJson(const PointStatistics& statistics)
{
  nlohmann::ordered_json object;
  object["points"] = statistics.all.points;
  object["points_rejected"] = rejectedJson(statistics.counted);
  object["bounds"] = boundsJson(statistics.all.bounds);
  const std::optional<double> density = statistics.density();
  object["density"] = { { "points_per_square_unit",
                          density ? nlohmann::ordered_json(*density) : nlohmann::ordered_json() },
    { "cell_size", statistics.cellSize }, { "occupied_cells", statistics.occupiedCells },
    { "method", densityMethod } };
  object["attributes"] = componentsJson(statistics, statistics.all);
  object["classes"] = nlohmann::ordered_json::array();
  for (const auto& [number, group] : statistics.classes)
  {
    object["classes"].push_back({ { "class", number }, { "name", objectClassName(number) },
      { "points", group.points }, { "bounds", boundsJson(group.bounds) },
      { "attributes", componentsJson(statistics, group) } });
  }
  return object;
}

std::string statisticsText(const PointStatistics& statistics)
{
  std::string text = "\n  density     ";
  if (const std::optional<double> density = statistics.density())
  {
    const std::string side = numberText(statistics.cellSize);
    text += numberText(*density) +
      " points per square unit: " + std::to_string(statistics.all.points) + " points in " +
      std::to_string(statistics.occupiedCells) + " ground cells of " + side + " x " + side +
      " that hold one";
  }
  else
  {
    text += "not known: the points cover no ground";
  }
  text += "\n  all points" + groupText(statistics, statistics.all);
  for (const auto& [number, group] : statistics.classes)
  {
    text += "\n  class " + std::to_string(number) + " (" + objectClassName(number) +
      "): " + std::to_string(group.points) + " points, bounds " + boundsText(group.bounds);
    text += statistics.classes.size() > 1 ? groupText(statistics, group) : " (all)";
  }
  return text;
}

} // namespace pointfront
