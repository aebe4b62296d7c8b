// Uses the installed kernel and nothing else: opens a store, decodes all of its points and draws
// them.
#include <SoftwareComposition.h>

#include <pointfront/Store/PointStore.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <utility>

namespace
{

/// From above, all points of the store, each a pixel; returns how many pixels show something.
std::ptrdiff_t drawn(
  const pointfront::StoreDescription& store, std::vector<pointfront::PlanItem> items)
{
  pointfront::FramePlan plan;
  const glm::dvec3 middle = 0.5 * (store.bounds.low + store.bounds.high);
  const glm::dvec3 size = store.bounds.high - store.bounds.low;
  plan.camera = pointfront::FrameCamera::parallelView(middle + glm::dvec3(0.0, 0.0, 2.0 * size.z),
    middle, { 0.0, 1.0, 0.0 }, 0.5 * std::max(size.x, size.y), size.z, 4.0 * size.z, 200, 200);
  plan.grid = store.grid;
  plan.schema = std::make_shared<const pointfront::AttributeSchema>();
  auto style = std::make_shared<pointfront::ResolvedStyle>();
  plan.batches.push_back({ 0, std::move(style), std::move(items) });
  pointfront::SoftwareRasteriser rasteriser;
  pointfront::SoftwareComposition composition;
  pointfront::SoftwareTarget target;
  target.reset(plan.camera.width, plan.camera.height);
  composition.draw(rasteriser, plan, target);
  composition.finish(plan.camera, plan.shading, target);
  return std::count_if(
    target.depth.begin(), target.depth.end(), [](float depth) { return std::isfinite(depth); });
}

} // namespace

int main(int argc, char* argv[])
{
  if (argc != 2)
  {
    std::fprintf(stderr, "usage: KernelConsumer STORE\n");
    return 2;
  }
  const auto store = pointfront::PointStore::open(argv[1]);
  if (!store)
  {
    std::fprintf(stderr, "%s\n", store.error().what.c_str());
    return 1;
  }
  std::size_t points = 0;
  std::vector<pointfront::PlanItem> items;
  const pointfront::NodeIndex nodes = (*store)->hierarchy()->nodeCount();
  for (pointfront::NodeIndex node = 0; node < nodes; ++node)
  {
    auto columns = (*store)->read(node, {});
    if (!columns)
    {
      std::fprintf(stderr, "%s\n", columns.error().what.c_str());
      return 1;
    }
    points += columns->size();
    pointfront::PlanItem item;
    item.last = static_cast<std::uint32_t>(columns->size());
    item.node = std::make_shared<const pointfront::NodeColumns>(std::move(*columns));
    items.push_back(std::move(item));
  }
  if (drawn((*store)->description(), std::move(items)) < 10000)
  {
    std::fprintf(stderr, "less than a quarter of the picture shows something\n");
    return 1;
  }
  std::printf("%zu points in %u nodes\n", points, nodes);
  return 0;
}
