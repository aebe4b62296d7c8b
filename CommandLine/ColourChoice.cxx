#include "ColourChoice.h"

#include "pointfront/Store/StoreSample.h"

#include <algorithm>
#include <limits>

namespace pointfront
{

namespace
{
constexpr double lowShare = 0.02;
constexpr double highShare = 0.98;

/// Smallest and largest stored value over all components; {0, 0} if it is not known.
std::array<double, 2> storedRange(const StoreDescription& store, std::size_t column)
{
  std::array<double, 2> range{ std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };
  if (column < store.ranges.size())
  {
    for (const std::array<double, 2>& component : store.ranges[column].components)
    {
      range = { std::min(range[0], component[0]), std::max(range[1], component[1]) };
    }
  }
  return range[0] <= range[1] ? range : std::array<double, 2>{ 0.0, 0.0 };
}

double inWorldUnits(const Attribute& attribute, double stored)
{
  return stored * attribute.scale + attribute.offset;
}

struct TwoRanges
{
  std::array<double, 2> robust{ std::numeric_limits<double>::infinity(),
    -std::numeric_limits<double>::infinity() };
  std::array<double, 2> whole = robust;

  void add(std::array<double, 2> robustOfOne, std::array<double, 2> wholeOfOne)
  {
    robust = { std::min(robust[0], robustOfOne[0]), std::max(robust[1], robustOfOne[1]) };
    whole = { std::min(whole[0], wholeOfOne[0]), std::max(whole[1], wholeOfOne[1]) };
  }
  std::array<double, 2> best() const
  {
    if (robust[0] < robust[1])
    {
      return robust;
    }
    return whole[0] < whole[1] ? whole : std::array<double, 2>{ whole[0], whole[0] + 1.0 };
  }
};

Result<TwoRanges> rangesOf(
  const std::string& attribute, const std::vector<std::shared_ptr<const StoredCloud>>& stores)
{
  TwoRanges ranges;
  for (const std::shared_ptr<const StoredCloud>& store : stores)
  {
    const StoreDescription& description = store->description();
    ColumnSelection selection;
    const std::optional<std::size_t> column = description.schema.find(attribute);
    if (attribute != "elevation" && !column)
    {
      continue;
    }
    if (attribute != "elevation")
    {
      selection.push_back(static_cast<std::uint32_t>(*column));
    }
    const Result<StoreSample> sample = StoreSample::read(
      *store->hierarchy(), *store, description.grid, description.schema, selection);
    if (!sample)
    {
      return sample.error();
    }
    if (selection.empty())
    {
      ranges.add({ sample->elevationQuantile(lowShare), sample->elevationQuantile(highShare) },
        { description.bounds.low.z, description.bounds.high.z });
    }
    else
    {
      const Attribute& stored = description.schema[*column];
      const std::array<double, 2> whole = storedRange(description, *column);
      ranges.add({ inWorldUnits(stored, sample->columnQuantile(0, 0, lowShare)),
                   inWorldUnits(stored, sample->columnQuantile(0, 0, highShare)) },
        { inWorldUnits(stored, whole[0]), inWorldUnits(stored, whole[1]) });
    }
  }
  return ranges;
}

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

Error missing(const std::string& attribute)
{
  const std::string name = withUnderscores(attribute);
  std::string hint = " (info lists them)";
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
      return missing(attribute);
    }
    choice.table = viridisTable();
    return choice; // from 0 to 1
  }
  if (!found && choice.attribute != "elevation")
  {
    return missing(attribute);
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
    choice.table = greyTable(); // of what a mapper would do with one component
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
  const Result<TwoRanges> ranges = rangesOf(choice.attribute, stores);
  if (!ranges)
  {
    return ranges.error();
  }
  choice.range = ranges->best();
  choice.table = choice.attribute == "intensity" ? greyTable() : viridisTable();
  return choice;
}

} // namespace pointfront
