#include "TextFormat.h"

#include "PTXTable.h"
#include "TextColumns.h"
#include "TextTable.h"

#include "pointfront/Base/MemoryMap.h"
#include "pointfront/Table/TableSource.h"

#include <utility>

namespace pointfront
{

bool TextFormat::accepts(const std::string& path) const
{
  const Result<MemoryMap> map = MemoryMap::open(path);
  if (!map || map->size() == 0)
  {
    return false;
  }
  const std::string_view text = beginningOf(*map);
  return text.find('\0') == std::string_view::npos &&
    (PTXTable::accepts(text) || TextColumns::find(text, {}, path).ok());
}

Result<std::unique_ptr<PointSource>> TextFormat::open(const std::string& path) const
{
  Result<MemoryMap> map = MemoryMap::open(path);
  if (!map)
  {
    return map.error();
  }
  if (map->size() == 0)
  {
    return makeError(Error::Kind::BadFormat, path + ": the file is empty");
  }
  const bool ptx = PTXTable::accepts(beginningOf(*map));
  Result<std::unique_ptr<PointTable>> table = ptx
    ? PTXTable::open(path, std::move(*map), survey_)
    : TextTable::open(path, std::move(*map), columns_, survey_);
  if (!table)
  {
    return table.error();
  }
  return TableSource::open(std::move(*table), survey_);
}

} // namespace pointfront
