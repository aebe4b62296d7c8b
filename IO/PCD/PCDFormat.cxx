#include "PCDFormat.h"

#include "PCDBinaryTable.h"
#include "PCDFile.h"
#include "PCDTextTable.h"

#include "pointfront/Disk/SmallFile.h"
#include "pointfront/Table/TableSource.h"

#include <algorithm>
#include <utility>

namespace pointfront
{

bool PCDFormat::accepts(const std::string& path) const
{
  const std::string start = beginningOf(path, 512);
  if (start.rfind("# .PCD", 0) == 0)
  {
    return true;
  }
  std::size_t line = 0;
  while (line < start.size() && (start[line] == '#' || start[line] == '\n' || start[line] == '\r'))
  {
    line = std::min(start.find('\n', line), start.size() - 1) + 1;
  }
  const std::string first = start.substr(std::min(line, start.size()), 8);
  return first.rfind("VERSION ", 0) == 0 || first.rfind("FIELDS ", 0) == 0;
}

Result<std::unique_ptr<PointSource>> PCDFormat::open(const std::string& path) const
{
  Result<PCDFile> file = PCDFile::open(path);
  if (!file)
  {
    return file.error();
  }
  if (file->fields.empty())
  {
    return makeError(Error::Kind::BadFormat, path + ": the PCD file has no field of use");
  }
  Result<std::unique_ptr<PointTable>> table = file->header.encoding == PCDEncoding::Ascii
    ? PCDTextTable::open(std::move(*file), survey_)
    : PCDBinaryTable::open(std::move(*file), temporaryFolder_);
  if (!table)
  {
    return table.error();
  }
  return TableSource::open(std::move(*table), survey_);
}

} // namespace pointfront
