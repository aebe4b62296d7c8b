#include "StoreInputFormat.h"

#include "IndexedLASFile.h"
#include "LASFormat.h"

#include "pointfront/Query/StoredPoints.h"
#include "pointfront/Store/PointStore.h"

#include <utility>

namespace pointfront
{

namespace
{
/// A LAS file that was named by its index.
class IndexedPoints final : public PointSource
{
public:
  IndexedPoints(std::unique_ptr<PointSource> original, std::string sidePath)
    : original_(std::move(original))
    , description_(original_->description())
  {
    description_.furtherFiles.push_back(std::move(sidePath));
  }
  const SourceDescription& description() const override { return description_; }
  std::uint64_t chunkCount() const override { return original_->chunkCount(); }
  std::uint64_t chunkPoints(std::uint64_t chunk) const override
  {
    return original_->chunkPoints(chunk);
  }
  Result<void> read(std::uint64_t chunk, PointBatch& batch) const override
  {
    return original_->read(chunk, batch);
  }
  Result<void> readSteps(std::uint64_t chunk, PointBatch& batch) const override
  {
    return original_->readSteps(chunk, batch);
  }

private:
  std::unique_ptr<PointSource> original_;
  SourceDescription description_;
};

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
  return std::unique_ptr<PointSource>(std::make_unique<IndexedPoints>(std::move(*points), path));
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
