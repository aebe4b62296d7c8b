#include "PLYFormat.h"

#include "PLYBinaryTable.h"
#include "PLYFile.h"
#include "PLYTextTable.h"

#include "pointfront/Disk/SmallFile.h"
#include "pointfront/Table/TableSource.h"

#include <utility>

namespace pointfront
{

bool PLYFormat::accepts(const std::string& path) const
{
  const std::string start = beginningOf(path, 4);
  return start.size() == 4 && start.compare(0, 3, "ply") == 0 &&
    (start[3] == '\n' || start[3] == '\r' || start[3] == ' ');
}

Result<std::unique_ptr<PointSource>> PLYFormat::open(const std::string& path) const
{
  Result<PLYFile> file = PLYFile::open(path);
  if (!file)
  {
    return file.error();
  }
  if (file->fields().empty())
  {
    return makeError(Error::Kind::BadFormat,
      path + ": its element '" + file->pointElement().name + "' has no properties");
  }
  const bool text = file->header.encoding == PLYEncoding::Ascii;
  Result<std::unique_ptr<PointTable>> table =
    text ? PLYTextTable::open(std::move(*file), survey_) : PLYBinaryTable::open(std::move(*file));
  if (!table)
  {
    return table.error();
  }
  return TableSource::open(std::move(*table), survey_);
}

} // namespace pointfront
