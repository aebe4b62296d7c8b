#include "GpuAccount.h"

#include "GpuPool.h"

#include <algorithm>

namespace pointfront
{

void GpuAccount::join(GpuPool& pool) { pools_.push_back(&pool); }

void GpuAccount::leave(GpuPool& pool)
{
  pools_.erase(std::remove(pools_.begin(), pools_.end(), &pool), pools_.end());
}

void GpuAccount::reclaim(std::int64_t bytes, const GpuPool& asking)
{
  const std::int64_t enough = bytes_ - bytes;
  for (GpuPool* pool : pools_)
  {
    while (pool != &asking && bytes_ > enough && pool->giveBack())
    {
    }
  }
}

} // namespace pointfront
