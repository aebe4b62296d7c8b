#include "SharedParts.h"

#include "pointfront/Plan/PictureExchange.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

namespace pointfront
{
namespace
{

/// Groups are numbered by classes.
constexpr std::size_t groupsOfPlace = 512;
constexpr std::size_t valuesOfPart = 2; ///< opacity, and 0 where splats are blended
constexpr float noPart = std::numeric_limits<float>::infinity();

std::size_t placeOf(const PlanPart& part)
{
  const std::size_t lens = static_cast<std::size_t>(part.lens + 1);
  return (2 * lens + (part.mask ? 1 : 0)) * groupsOfPlace + part.group;
}

PlanPart partAt(std::size_t place)
{
  PlanPart part;
  part.group = static_cast<std::uint16_t>(place % groupsOfPlace);
  part.mask = place / groupsOfPlace % 2 == 1;
  part.lens = static_cast<std::int16_t>(static_cast<int>(place / (2 * groupsOfPlace)) - 1);
  return part;
}

bool blends(const PlanPart& part)
{
  return !part.mask &&
    std::any_of(part.plan.batches.begin(), part.plan.batches.end(),
      [](const DrawBatch& batch)
      {
        return batch.style->technique == Technique::Ewa ||
          (batch.style->technique == Technique::Splats && batch.style->blended);
      });
}

} // namespace

std::vector<PlanPart> partsOfAll(const FramePlan& plan)
{
  std::vector<PlanPart> own = partsOf(plan);
  const std::size_t places = 2 * groupsOfPlace * (plan.shading.lenses.size() + 1);
  std::vector<float> values(valuesOfPart * places, noPart);
  for (const PlanPart& part : own)
  {
    float* const mine = &values[valuesOfPart * placeOf(part)];
    mine[0] = static_cast<float>(part.opacity);
    mine[1] = blends(part) ? 0.0f : noPart;
  }
  std::vector<PlanPart> all;
  if (!plan.exchange->nearest(values.data(), values.size()))
  {
    return all;
  }
  auto next = own.begin();
  for (std::size_t place = 0; place < places; ++place)
  {
    const float* const agreed = &values[valuesOfPart * place];
    if (agreed[0] == noPart)
    {
      continue;
    }
    const bool here = next != own.end() && placeOf(*next) == place;
    all.push_back(here ? std::move(*next) : partAt(place));
    next += here ? 1 : 0;
    PlanPart& part = all.back();
    static_cast<FrameSetting&>(part.plan) = plan;
    part.opacity = static_cast<double>(agreed[0]);
    part.plan.keepsVisible = false; // the kept points are those of this process alone
    part.plan.exchange = agreed[1] == 0.0f ? plan.exchange : nullptr;
  }
  return all;
}

} // namespace pointfront
