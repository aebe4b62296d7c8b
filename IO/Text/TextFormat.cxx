#include "TextFormat.h"

#include "PTXTable.h"
#include "TextBytes.h"
#include "TextColumns.h"
#include "TextTable.h"

#include "pointfront/Table/TableSource.h"

#include <utility>

namespace pointfront
{

bool TextFormat::accepts(const std::string& path) const
{
  const std::string text = beginningOfText(path);
  return !text.empty() && text.find('\0') == std::string::npos &&
    (PTXTable::accepts(text) || TextColumns::find(text, {}, path, choice_).ok());
}

Result<std::unique_ptr<PointSource>> TextFormat::open(const std::string& path) const
{
  Result<MemoryMap> map = mapText(path, temporaryFolder_);
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
    : TextTable::open(path, std::move(*map), { columns_, choice_ }, survey_);
  if (!table)
  {
    return table.error();
  }
  return TableSource::open(std::move(*table), survey_);
}

} // namespace pointfront
