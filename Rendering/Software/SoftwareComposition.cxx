#include "SoftwareComposition.h"

#include "HoleFiller.h"
#include "PixelRectangle.h"
#include "SharedParts.h"
#include "SharedSums.h"

#include "pointfront/Threads/ThreadCrew.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

namespace pointfront
{
namespace
{

constexpr float nothingThere = std::numeric_limits<float>::infinity();

std::size_t placeIn(const SoftwareTarget& target, int x, int y)
{
  return static_cast<std::size_t>(y - target.bottom) * static_cast<std::size_t>(target.width) +
    static_cast<std::size_t>(x - target.left);
}

/// Straight colours; rounded to bytes.
std::uint32_t over(std::uint32_t front, float opacity, std::uint32_t behind)
{
  std::uint8_t near[4], far[4];
  std::memcpy(near, &front, 4);
  std::memcpy(far, &behind, 4);
  const float a = opacity * (static_cast<float>(near[3]) / 255.0f);
  const float b = (1.0f - a) * (static_cast<float>(far[3]) / 255.0f);
  const float sum = a + b;
  for (int c = 0; c < 3 && sum > 0.0f; ++c)
  {
    const float mixed = (a * static_cast<float>(near[c]) + b * static_cast<float>(far[c])) / sum;
    far[c] = static_cast<std::uint8_t>(mixed + 0.5f);
  }
  far[3] = static_cast<std::uint8_t>(255.0f * sum + 0.5f);
  std::uint32_t result;
  std::memcpy(&result, far, 4);
  return result;
}

/// The content of one pixel of a translucent part.
struct TranslucentPixel
{
  float depth;
  float opacity;
  std::uint32_t rgba;
  const SoftwareTarget* target;
  std::size_t pixel;
};

void put(const TranslucentPixel& nearest, SoftwareTarget& target, std::size_t pixel)
{
  if (target.depth[pixel] == nothingThere)
  {
    target.depth[pixel] = nearest.depth;
    if (target.keepDecided)
    {
      target.decided[pixel] = nearest.target->decided[nearest.pixel];
    }
  }
  if (!target.highlights.empty())
  {
    const PictureValues<std::uint8_t>& marks = nearest.target->highlights;
    target.highlights[pixel] = marks.empty() ? std::uint8_t(0) : marks[nearest.pixel];
  }
  if (target.keepPoints)
  {
    target.points[pixel] = nearest.target->points[nearest.pixel];
  }
}

/// The same from picture to picture, so that each part goes on from its own last one.
std::uint16_t numberOf(const PlanPart& part)
{
  return static_cast<std::uint16_t>(((part.lens + 1) << 10) + (part.mask ? 512 : 0) + part.group);
}

PixelRectangle wider(const PixelRectangle& place, int by, const FrameCamera& camera)
{
  const PixelRectangle larger{ place.left - by, place.bottom - by, place.right + by,
    place.top + by };
  return place.empty() ? place : common({ 0, 0, camera.width, camera.height }, larger);
}

} // namespace

SoftwareTarget& SoftwareComposition::begin(const PlanPart& part, const FrameShading& shading,
  const FrameCamera& camera, const SoftwareTarget& whole)
{
  Part& own = parts_[{ part.lens, part.mask, part.group }];
  own.opacity = part.opacity;
  if (!own.begun)
  {
    own.begun = true;
    PixelRectangle place = whole.rectangle();
    const auto lens = static_cast<std::size_t>(std::max<std::int16_t>(part.lens, 0));
    if (part.lens >= 0 && lens < shading.lenses.size())
    {
      const std::array<int, 4> e = shading.lenses[lens].extent(camera.width, camera.height);
      place = common(place, wider({ e[0], e[1], e[2], e[3] }, shading.reachPx(), camera));
    }
    own.target.keepPoints = whole.keepPoints;
    own.target.keepDecided = whole.keepDecided;
    own.target.reset(place);
  }
  return own.target;
}

RasterStatistics SoftwareComposition::draw(SoftwareRasteriser& rasteriser, const FramePlan& plan,
  SoftwareTarget& target, std::uint16_t store)
{
  if (!plan.exchange && !isComposed(plan))
  {
    return rasteriser.draw(plan, target, store);
  }
  std::vector<PlanPart> parts = plan.exchange ? partsOfAll(plan) : std::vector<PlanPart>();
  shared_ = !parts.empty();
  parts = shared_ ? std::move(parts) : partsOf(plan);
  const PixelRectangle viewport{ 0, 0, plan.camera.width, plan.camera.height };
  const bool complete = target.rectangle().contains(viewport);
  RasterStatistics all;
  for (PlanPart& part : parts)
  {
    const bool whole = part.lens < 0 && part.group == 0;
    SoftwareTarget& own = whole ? target : begin(part, plan.shading, plan.camera, target);
    part.plan.exchange = shared_ ? part.plan.exchange : nullptr;
    if (part.mask)
    {
      part.plan.shading = FrameShading();
      part.plan.keepsVisible = false;
    }
    if (!own.rectangle().empty())
    {
      const RasterStatistics drawn =
        rasteriser.draw(part.plan, own, store, { numberOf(part), complete });
      all.points += drawn.points;
      all.reused += drawn.reused;
      all.standIns += drawn.standIns;
      all.drawn += drawn.drawn;
      all.blended += drawn.blended;
      all.keptVisible += drawn.keptVisible;
      all.milliseconds += drawn.milliseconds;
    }
  }
  return all;
}

RasterStatistics SoftwareComposition::drawShown(
  SoftwareRasteriser& rasteriser, const FramePlan& plan, SoftwareTarget& target)
{
  if (!isComposed(plan) && plan.shading.highlights.empty() && !plan.exchange)
  {
    return rasteriser.drawShown(plan, target);
  }
  // Kept points, and those of other processes, may lie anywhere.
  target.reset(plan.keepsVisible || plan.exchange
      ? PixelRectangle{ 0, 0, plan.camera.width, plan.camera.height }
      : wider(shownRectangle(plan), plan.shading.reachPx(), plan.camera));
  return target.rectangle().empty() ? RasterStatistics() : draw(rasteriser, plan, target);
}

/// Blends the translucent parts that are not behind opaque ones.
void SoftwareComposition::blendGroups(std::int16_t lens, SoftwareTarget& target)
{
  std::vector<const Part*> groups;
  for (const auto& [key, part] : parts_)
  {
    if (key.lens == lens && key.group > 0 && part.begun)
    {
      groups.push_back(&part);
    }
  }
  ThreadCrew::ofProcess().run(groups.empty() ? 0 : static_cast<std::size_t>(target.height),
    [&](std::size_t row, unsigned)
    {
      std::vector<TranslucentPixel> layers;
      for (int x = target.left; x < target.left + target.width; ++x)
      {
        const int y = target.bottom + static_cast<int>(row);
        const std::size_t pixel = placeIn(target, x, y);
        layers.clear();
        for (const Part* group : groups)
        {
          const std::size_t own = placeIn(group->target, x, y);
          const float depth = group->target.depth[own];
          if (depth < target.depth[pixel])
          {
            layers.push_back({ depth, static_cast<float>(group->opacity), group->target.rgba[own],
              &group->target, own });
          }
        }
        std::stable_sort(layers.begin(), layers.end(),
          [](const TranslucentPixel& a, const TranslucentPixel& b) { return a.depth > b.depth; });
        for (const TranslucentPixel& layer : layers)
        {
          target.rgba[pixel] = over(layer.rgba, layer.opacity, target.rgba[pixel]);
        }
        if (!layers.empty())
        {
          put(layers.back(), target, pixel);
        }
      }
    });
}

void SoftwareComposition::putLens(std::int16_t number, const FrameCamera& camera,
  const FrameShading& shading, SoftwareTarget& target)
{
  const FrameLens& lens = shading.lenses[static_cast<std::size_t>(number)];
  const auto find = [&](bool mask) -> const SoftwareTarget*
  {
    const auto part = parts_.find({ number, mask, 0 });
    return part != parts_.end() && part->second.begun ? &part->second.target : nullptr;
  };
  const SoftwareTarget* const inside = find(false);
  const SoftwareTarget* const mask = find(true);
  const std::array<int, 4> e = lens.extent(camera.width, camera.height);
  const PixelRectangle place = common({ e[0], e[1], e[2], e[3] }, target.rectangle());
  const auto covers = [&](int x, int y)
  {
    return lens.shape != LensShape::AroundClass
      ? lens.covers(x, y, camera.width, camera.height)
      : mask && mask->depth[placeIn(*mask, x, y)] != nothingThere;
  };
  ThreadCrew::ofProcess().run(place.empty() ? 0 : static_cast<std::size_t>(place.height()),
    [&](std::size_t row, unsigned)
    {
      const int y = place.bottom + static_cast<int>(row);
      for (int x = place.left; x < place.right; ++x)
      {
        if (!covers(x, y))
        {
          continue;
        }
        const std::size_t pixel = placeIn(target, x, y);
        const std::size_t from = inside ? placeIn(*inside, x, y) : 0;
        target.rgba[pixel] = inside ? inside->rgba[from] : 0;
        target.depth[pixel] = inside ? inside->depth[from] : nothingThere;
        if (target.keepDecided)
        {
          target.decided[pixel] = inside ? inside->decided[from] : nothingThere;
        }
        if (!target.highlights.empty())
        {
          target.highlights[pixel] =
            inside && !inside->highlights.empty() ? inside->highlights[from] : std::uint8_t(0);
        }
        if (target.keepPoints)
        {
          target.points[pixel] = inside ? inside->points[from] : PixelPoint();
        }
      }
    });
}

void SoftwareComposition::finish(const FrameCamera& camera, const FrameShading& shading,
  SoftwareTarget& target, PictureExchange* others)
{
  for (auto part = parts_.begin(); part != parts_.end();)
  {
    part = part->second.begun ? std::next(part) : parts_.erase(part);
  }
  others = shared_ ? others : nullptr;
  // A composition of several pictures, and effects that look around a pixel, take those of all
  // processes: each has the whole picture then.
  const bool composed = !parts_.empty() || !shading.highlights.empty();
  PictureExchange* const all = composed || shading.reachPx() > 0 ? others : nullptr;
  // A part may lack highlighted points that another one puts over it.
  const auto mark = [&](SoftwareTarget& drawn)
  { drawn.highlights.resize(shading.highlights.empty() ? 0 : drawn.depth.size()); };
  mark(target);
  shade(camera, shading, target, all);
  for (auto& [key, part] : parts_)
  {
    PictureValues<float>& depths = part.target.depth;
    if (!key.mask)
    {
      mark(part.target);
      shade(camera, shading, part.target, all);
    }
    else if (all && !depths.empty())
    {
      all->nearest(depths.data(), depths.size());
    }
  }
  for (const CompositionStep& step : compositionOf(shading))
  {
    const auto inside = parts_.find({ step.lens, false, 0 });
    switch (step.kind)
    {
      case CompositionStep::Kind::BlendGroups:
        if (step.lens < 0 || inside != parts_.end())
        {
          blendGroups(step.lens, step.lens < 0 ? target : inside->second.target);
        }
        break;
      case CompositionStep::Kind::PutLens:
        putLens(step.lens, camera, shading, target);
        break;
      case CompositionStep::Kind::Highlight:
        highlight(shading, target);
        break;
    }
  }
  for (auto& [key, part] : parts_)
  {
    part.begun = false;
  }
  shared_ = false;
}

} // namespace pointfront
