#include "pointfront/Points/AttributeNames.h"

#include "pointfront/Base/NearestName.h"

namespace pointfront
{

std::vector<std::string> attributeNames(const AttributeSchema& schema)
{
  std::vector<std::string> names;
  for (const Attribute& attribute : schema)
  {
    names.push_back(attribute.name);
  }
  return names;
}

std::string meantAttribute(const AttributeSchema& schema, const std::string& name)
{
  std::vector<std::string> known = attributeNames(schema);
  for (const char* derived : { "elevation", "horizontality", "global_height" })
  {
    known.emplace_back(derived);
  }
  return didYouMean(name.substr(0, name.find_first_of(".[")), known);
}

} // namespace pointfront
