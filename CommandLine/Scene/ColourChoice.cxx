#include "ColourChoice.h"

#include "pointfront/Points/AttributeNames.h"
#include "pointfront/Style/AttributeRanges.h"

#include <algorithm>

namespace pointfront
{

namespace
{
std::string withUnderscores(std::string name)
{
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
}

/// By its name, or by that name with underscores.
const Attribute* findIn(
  const std::vector<std::shared_ptr<const StoredCloud>>& stores, const std::string& name)
{
  for (const std::string& spelling : { name, withUnderscores(name) })
  {
    for (const std::shared_ptr<const StoredCloud>& store : stores)
    {
      const AttributeSchema& schema = store->description().schema;
      if (const std::optional<std::size_t> column = schema.find(spelling))
      {
        return &schema[*column];
      }
    }
  }
  return nullptr;
}

Error missing(
  const std::string& attribute, const std::vector<std::shared_ptr<const StoredCloud>>& stores)
{
  const std::string name = withUnderscores(attribute);
  AttributeSchema all;
  for (const std::shared_ptr<const StoredCloud>& store : stores)
  {
    for (const Attribute& one : store->description().schema)
    {
      all.add(one);
    }
  }
  std::string hint = " (info lists them)" + meantAttribute(all, attribute);
  if (name == "normal" || name == "horizontality")
  {
    hint = ", which --color-by " + attribute + " needs: build it with --normals pca";
  }
  else if (name == "local_height")
  {
    hint = ": build it with --local-height";
  }
  return makeError(Error::Kind::BadArgument,
    "--color-by: no store here has the attribute '" +
      std::string(name == "horizontality" ? "normal" : attribute) + "'" + hint);
}
} // namespace

Result<ColourChoice> chooseColour(
  const std::string& attribute, const std::vector<std::shared_ptr<const StoredCloud>>& stores)
{
  const Attribute* found = findIn(stores, attribute);
  ColourChoice choice;
  choice.attribute = found ? found->name : withUnderscores(attribute);
  if (!found && (choice.attribute == "global_height" || choice.attribute == "horizontality"))
  {
    if (choice.attribute == "horizontality" && !findIn(stores, "normal"))
    {
      return missing(attribute, stores);
    }
    choice.table = viridisTable();
    return choice; // from 0 to 1
  }
  if (!found && choice.attribute != "elevation")
  {
    return missing(attribute, stores);
  }
  if (choice.attribute == "rgb")
  {
    choice.direct = true;
    return choice;
  }
  if (choice.attribute == "normal" && found->components == 3)
  {
    choice.vector = true;
    choice.range = { -1.0, 1.0 };
    choice.table = greyTable(); // as a mapper would draw one component
    return choice;
  }
  if (found && found->components != 1)
  {
    return makeError(Error::Kind::BadArgument,
      "--color-by: '" + attribute + "' has several components and cannot be mapped to colours");
  }
  if (choice.attribute == "classification")
  {
    choice.table = classificationTable();
    choice.range = { -0.5, 255.5 }; // code c falls into the middle of entry c
    return choice;
  }
  const Result<std::array<double, 2>> range = AttributeRanges(stores).of(choice.attribute);
  if (!range)
  {
    return range.error();
  }
  choice.range = *range;
  choice.table = choice.attribute == "intensity" ? greyTable() : viridisTable();
  return choice;
}

} // namespace pointfront
