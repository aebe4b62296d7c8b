#include "pointfront/Plan/FramePlan.h"

#include <algorithm>
#include <map>
#include <numeric>
#include <ostream>

namespace pointfront
{

std::uint64_t FramePlan::pointCount() const
{
  const std::vector<std::uint64_t> layers = layerPoints();
  return std::accumulate(layers.begin(), layers.end(), std::uint64_t(0));
}

std::vector<std::uint64_t> FramePlan::layerPoints() const
{
  std::vector<std::uint64_t> points;
  // The largest of a layer's batches: the others are parts of it.
  std::map<std::uint16_t, const DrawBatch*> largest;
  for (const DrawBatch& batch : batches)
  {
    const DrawBatch*& known = largest[batch.layer];
    known = known && known->items.size() >= batch.items.size() ? known : &batch;
  }
  for (const auto& [layer, batch] : largest)
  {
    points.resize(layer + std::size_t(1), 0);
    for (const PlanItem& item : batch->items)
    {
      points[layer] += item.last - item.first;
    }
  }
  return points;
}

std::size_t FramePlan::nodeCount() const
{
  std::size_t nodes = 0;
  for (const DrawBatch& batch : batches)
  {
    nodes += batch.items.size();
  }
  return nodes;
}

double FramePlan::fillPx() const
{
  constexpr double pi = 3.14159265358979;
  double pixels = 0.0;
  for (const DrawBatch& batch : batches)
  {
    if (batch.style->size.mode != SplatSize::Mode::Spacing)
    {
      continue;
    }
    for (const PlanItem& item : batch.items)
    {
      const double radius = std::max(spacingPx, item.growingSpacingPx) * batch.style->size.value;
      pixels += pi * radius * radius * double(item.last - item.first);
    }
  }
  return pixels;
}

std::ostream& operator<<(std::ostream& out, const FramePlan& plan)
{
  out << "frame " << plan.camera.width << " x " << plan.camera.height
      << (plan.camera.parallel ? ", parallel" : ", perspective") << ", "
      << plan.clippingPlanes.size() << " clipping planes\n";
  for (const DrawBatch& batch : plan.batches)
  {
    out << "layer " << batch.layer << ", technique " << static_cast<int>(batch.style->technique)
        << ", " << batch.items.size() << " nodes\n";
    for (const PlanItem& item : batch.items)
    {
      out << "  node " << item.node->node << " [" << item.first << ", " << item.last << ")";
      if (!item.growth.whole())
      {
        out << " growing " << item.growth.of(item.first) << " to "
            << item.growth.of(std::max(1u, item.last) - 1);
      }
      out << " spacing " << item.spacing << "\n";
    }
  }
  return out;
}

} // namespace pointfront
