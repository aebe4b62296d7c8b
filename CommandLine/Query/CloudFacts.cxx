#include "CloudFacts.h"

#include <nlohmann/json.hpp>

#include <cstdio>

namespace pointfront
{

nlohmann::ordered_json boundsJson(const Bounds& b)
{
  return b.empty()
    ? nlohmann::ordered_json()
    : nlohmann::ordered_json{ b.low.x, b.low.y, b.low.z, b.high.x, b.high.y, b.high.z };
}

std::string boundsText(const Bounds& b)
{
  if (b.empty())
  {
    return "none";
  }
  char text[200];
  std::snprintf(text, sizeof text, "%.15g %.15g %.15g to %.15g %.15g %.15g", b.low.x, b.low.y,
    b.low.z, b.high.x, b.high.y, b.high.z);
  return text;
}

std::string rejectedText(const PointCount& counted)
{
  std::string text;
  for (const auto& [reason, count] : counted.rejected)
  {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + ' ' + reason;
  }
  return text;
}

nlohmann::ordered_json rejectedJson(const PointCount& counted)
{
  auto object = nlohmann::ordered_json::object();
  for (const auto& [reason, count] : counted.rejected)
  {
    object[reason] = count;
  }
  return object;
}

nlohmann::ordered_json attributesJson(const AttributeSchema& schema)
{
  auto list = nlohmann::ordered_json::array();
  for (const Attribute& attribute : schema)
  {
    list.push_back({ { "name", attribute.name }, { "type", std::string(nameOf(attribute.type)) },
      { "components", attribute.components } });
  }
  return list;
}

std::string attributesText(const AttributeSchema& schema)
{
  std::string text;
  for (const Attribute& attribute : schema)
  {
    text += (text.empty() ? "" : " ") + attribute.name + ':' + std::string(nameOf(attribute.type));
    text += attribute.components > 1 ? 'x' + std::to_string(attribute.components) : "";
  }
  return text;
}

} // namespace pointfront
