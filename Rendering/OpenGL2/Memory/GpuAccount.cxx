#include "GpuAccount.h"

#include "GpuPool.h"

#include <algorithm>

namespace pointfront
{

void GpuAccount::join(GpuPool& pool)
{
  members_.push_back({ &pool, false });
}

void GpuAccount::leave(GpuPool& pool)
{
  members_.erase(std::remove_if(members_.begin(), members_.end(),
                   [&](const Member& member) { return member.pool == &pool; }),
    members_.end());
}

void GpuAccount::draw(const GpuPool& pool, bool lowered)
{
  const auto own = std::find_if(
    members_.begin(), members_.end(), [&](const Member& member) { return member.pool == &pool; });
  if (own->drawn)
  {
    for (Member& member : members_)
    {
      member.drawn = false;
    }
    lowered_ = false;
  }
  own->drawn = true;
  lowered_ = lowered_ || lowered;
}

void GpuAccount::reclaim(std::int64_t bytes, const GpuPool& asking)
{
  const std::int64_t enough = bytes_ - bytes;
  const auto take = [&](GpuPool& pool)
  {
    while (&pool != &asking && bytes_ > enough && pool.giveBack())
    {
    }
  };
  for (const Member& member : members_)
  {
    take(*member.pool);
  }
  // The last to be drawn first: less is brought to the GPU again in the end.
  for (auto member = members_.rbegin(); lowered_ && member != members_.rend(); ++member)
  {
    if (!member->drawn && bytes_ > enough)
    {
      member->pool->leaveScreen();
      take(*member->pool);
    }
  }
}

} // namespace pointfront
