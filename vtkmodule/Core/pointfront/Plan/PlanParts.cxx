#include "pointfront/Plan/PlanParts.h"

#include <algorithm>
#include <utility>

namespace pointfront
{
namespace
{

PlanPart partOf(const ResolvedStyle& style)
{
  PlanPart part;
  part.lens = style.lens;
  part.mask = style.lensMask;
  part.group = style.lensMask ? std::uint16_t(0) : style.group;
  part.opacity = part.group > 0 ? style.opacity : 1.0;
  return part;
}

} // namespace

bool isComposed(const FramePlan& plan)
{
  const auto isApart = [](const DrawBatch& batch)
  { return batch.style->lens >= 0 || batch.style->group > 0; };
  return std::any_of(plan.batches.begin(), plan.batches.end(), isApart) ||
    std::any_of(plan.standIns.begin(), plan.standIns.end(), isApart);
}

std::vector<PlanPart> partsOf(const FramePlan& plan)
{
  std::vector<PlanPart> parts;
  const FrameSetting& setting = plan;
  const auto find = [&](PlanPart like) -> PlanPart&
  {
    const auto place = std::lower_bound(parts.begin(), parts.end(), like);
    if (place != parts.end() && !(like < *place))
    {
      return *place;
    }
    static_cast<FrameSetting&>(like.plan) = setting;
    return *parts.insert(place, std::move(like));
  };
  find(PlanPart());
  for (const DrawBatch& batch : plan.batches)
  {
    PlanPart opaque = partOf(*batch.style);
    find(opaque).plan.batches.push_back(batch);
    opaque.mask = false;
    opaque.group = 0;
    opaque.opacity = 1.0;
    find(opaque);
  }
  for (const DrawBatch& batch : plan.standIns)
  {
    find(partOf(*batch.style)).plan.standIns.push_back(batch);
  }
  return parts;
}

std::vector<CompositionStep> compositionOf(const FrameShading& shading)
{
  using Kind = CompositionStep::Kind;
  std::vector<CompositionStep> steps{ { Kind::BlendGroups } };
  for (std::size_t lens = 0; lens < shading.lenses.size(); ++lens)
  {
    if (!shading.lenses[lens].coversNothing())
    {
      steps.push_back({ Kind::BlendGroups, static_cast<std::int16_t>(lens) });
      steps.push_back({ Kind::PutLens, static_cast<std::int16_t>(lens) });
    }
  }
  steps.push_back({ Kind::Highlight });
  return steps;
}

} // namespace pointfront
