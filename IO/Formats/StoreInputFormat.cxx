#include "StoreInputFormat.h"

#include "IndexedLASFile.h"
#include "LASFormat.h"

#include "pointfront/Points/DescribedSource.h"
#include "pointfront/Query/StoredPoints.h"
#include "pointfront/Store/PointStore.h"

#include <utility>

namespace pointfront
{
namespace
{
Result<std::unique_ptr<PointSource>> openIndex(const std::string& path)
{
  const auto index = IndexedLASFile::open(path); // which checks that it is of the file as it is
  if (!index)
  {
    return index.error();
  }
  Result<std::unique_ptr<PointSource>> points = LASFormat().open((*index)->files().back());
  if (!points)
  {
    return points;
  }
  SourceDescription description = (*points)->description();
  description.furtherFiles.push_back(path);
  return std::unique_ptr<PointSource>(
    std::make_unique<DescribedSource>(std::move(*points), std::move(description)));
}
} // namespace

bool StoreInputFormat::accepts(const std::string& path) const
{
  return PointStore::looksLikeStore(path) || SideFile::looksLikeSideFile(path);
}

Result<std::unique_ptr<PointSource>> StoreInputFormat::open(const std::string& path) const
{
  if (SideFile::looksLikeSideFile(path))
  {
    return openIndex(path);
  }
  Result<std::shared_ptr<const PointStore>> store = PointStore::open(path);
  if (!store)
  {
    return store.error();
  }
  return StoredPoints::open(std::move(*store));
}

} // namespace pointfront
