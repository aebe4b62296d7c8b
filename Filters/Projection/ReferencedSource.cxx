#include "ReferencedSource.h"

#include <utility>

namespace pointfront
{

ReferencedSource::ReferencedSource(std::unique_ptr<PointSource> original,
  SourceDescription description, std::shared_ptr<const CoordinateTransform> transform)
  : original_(std::move(original))
  , description_(std::move(description))
  , transform_(std::move(transform))
{
}

Result<void> ReferencedSource::read(std::uint64_t chunk, PointBatch& batch) const
{
  if (Result<void> done = original_->read(chunk, batch); !done || !transform_)
  {
    return done;
  }
  const Result<void> done = transform_->apply(batch.positions.data(), batch.positions.size());
  if (!done)
  {
    return makeError(done.error().kind, description_.path + ": " + done.error().what);
  }
  return {};
}

} // namespace pointfront
