#include "pointfront/Points/AttributeSchema.h"

#include "pointfront/Base/LetterCase.h"

#include <algorithm>

namespace pointfront
{
bool AttributeSchema::add(Attribute attribute)
{
  const bool taken = std::any_of(attributes_.begin(), attributes_.end(),
    [&](const Attribute& other) { return other.name == attribute.name; });
  if (taken)
  {
    return false;
  }
  attributes_.push_back(std::move(attribute));
  return true;
}

std::optional<std::size_t> AttributeSchema::find(std::string_view name) const
{
  for (std::size_t i = 0; i < attributes_.size(); ++i)
  {
    if (attributes_[i].name == name)
    {
      return i;
    }
  }
  for (std::size_t i = 0; i < attributes_.size(); ++i)
  {
    if (sameWithoutCase(attributes_[i].name, name))
    {
      return i;
    }
  }
  return std::nullopt;
}

std::size_t AttributeSchema::pointBytes() const
{
  std::size_t sum = 0;
  for (const Attribute& attribute : attributes_)
  {
    sum += attribute.bytes();
  }
  return sum;
}

} // namespace pointfront
