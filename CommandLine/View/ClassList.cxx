#include "ClassList.h"

#include "pointfront/Points/ObjectClass.h"
#include "pointfront/Statistics/StoreSample.h"
#include "pointfront/Style/StyleSheet.h"

#include <algorithm>
#include <cstdio>
#include <set>

namespace pointfront
{

namespace
{
constexpr int sampleSteps = 1000; // a class of a thousandth of the points is found

/// Adds the codes of a store that keeps one tree for all classes.
Result<void> addSampled(const StoredCloud& store, std::set<std::uint8_t>& codes)
{
  const StoreDescription& description = store.description();
  const std::optional<std::size_t> column = description.schema.find("classification");
  if (!column)
  {
    return {};
  }
  const Result<StoreSample> sample = StoreSample::read(*store.hierarchy(), store, description.grid,
    description.schema, { static_cast<std::uint32_t>(*column) });
  if (!sample)
  {
    return sample.error();
  }
  for (int i = 0; i <= sampleSteps && sample->size() > 0; ++i)
  {
    const double share = static_cast<double>(i) / sampleSteps;
    codes.insert(static_cast<std::uint8_t>(sample->columnQuantile(0, 0, share)));
  }
  return {};
}
} // namespace

Result<ClassList> ClassList::of(const std::vector<std::shared_ptr<const StoredCloud>>& stores,
  const std::vector<std::uint8_t>& shown)
{
  std::set<std::uint8_t> codes;
  for (const auto& store : stores)
  {
    if (!isLayered(store->description()))
    {
      if (Result<void> added = addSampled(*store, codes); !added)
      {
        return added.error();
      }
      continue;
    }
    for (const Layer& layer : store->description().layers)
    {
      codes.insert(static_cast<std::uint8_t>(layer.objectClass));
    }
  }
  ClassList list;
  for (const std::uint8_t code : codes)
  {
    list.entries_.push_back(
      { code, shown.empty() || std::binary_search(shown.begin(), shown.end(), code) });
  }
  return list;
}

void ClassList::move(int steps)
{
  const auto count = static_cast<std::ptrdiff_t>(entries_.size());
  if (count > 0)
  {
    at_ = static_cast<std::size_t>(
      ((static_cast<std::ptrdiff_t>(at_) + steps) % count + count) % count);
  }
}

void ClassList::toggle()
{
  const auto shown =
    std::count_if(entries_.begin(), entries_.end(), [](const Entry& entry) { return entry.shown; });
  if (!entries_.empty() && (shown > 1 || !entries_[at_].shown))
  {
    entries_[at_].shown = !entries_[at_].shown;
  }
}

std::vector<std::uint8_t> ClassList::shown() const
{
  std::vector<std::uint8_t> codes;
  for (const Entry& entry : entries_)
  {
    if (entry.shown)
    {
      codes.push_back(entry.code);
    }
  }
  return codes.size() == entries_.size() ? std::vector<std::uint8_t>() : codes;
}

std::string ClassList::text() const
{
  std::string text;
  for (std::size_t i = 0; i < entries_.size(); ++i)
  {
    char line[80];
    std::snprintf(line, sizeof line, "%s [%s] %3d %s\n", i == at_ ? ">" : " ",
      entries_[i].shown ? "x" : " ", entries_[i].code, objectClassName(entries_[i].code).c_str());
    text += line;
  }
  return text;
}

} // namespace pointfront
