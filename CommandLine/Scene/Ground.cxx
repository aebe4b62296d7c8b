#include "Ground.h"

#include "pointfront/Statistics/StoreSample.h"
#include "pointfront/Store/StoredCloud.h"

namespace pointfront
{

Result<double> groundOf(const StoredCloud& store)
{
  const StoreDescription& description = store.description();
  const Result<StoreSample> sample =
    StoreSample::read(*store.hierarchy(), store, description.grid, description.schema, {});
  if (!sample)
  {
    return sample.error();
  }
  return sample->elevationQuantile(0.5);
}

} // namespace pointfront
