#include "pointfront/Residency/Residency.h"

#include "pointfront/Residency/LoadScheduler.h"
#include "pointfront/Residency/MemoryBudget.h"
#include "pointfront/Residency/StoreNodes.h"

#include <algorithm>

namespace pointfront
{
namespace
{

std::shared_ptr<LoadScheduler> ownScheduler(const ResidencyOptions& options)
{
  LoadSchedulerOptions own;
  own.budgetBytes = MemoryBudget::unlimited; // the store's own is all there is
  own.threads = std::max(options.loaderThreads, 1u);
  return std::make_shared<LoadScheduler>(own);
}

/// Until `reached` or the store is idle.
template <typename Condition>
void waitUntil(const StoreNodes& nodes, const Condition& reached)
{
  while (true)
  {
    const std::uint64_t seen = nodes.budget().changes();
    if (reached() || nodes.idle())
    {
      return;
    }
    nodes.budget().waitForChange(seen);
  }
}

} // namespace

Residency::Residency(std::shared_ptr<const NodeReader> reader, NodeIndex nodeCount,
  std::shared_ptr<LoadScheduler> scheduler, std::uint64_t points)
  : scheduler_(std::move(scheduler))
  , nodes_(std::make_shared<StoreNodes>(std::move(reader), nodeCount,
      std::make_shared<MemoryBudget>(MemoryBudget::unlimited, scheduler_->budget())))
{
  scheduler_->join(nodes_, points);
}

Residency::Residency(
  std::shared_ptr<const NodeReader> reader, NodeIndex nodeCount, ResidencyOptions options)
  : Residency(std::move(reader), nodeCount, ownScheduler(options))
{
  nodes_->budget().setLimit(options.budgetBytes);
}

Residency::~Residency()
{
  scheduler_->leave(nodes_);
}

void Residency::setLayerColumns(const LayerColumns& columns)
{
  if (nodes_->setColumns(columns))
  {
    nodes_->budget().announceChange();
    scheduler_->loadWithoutThreads();
  }
}

LayerColumns Residency::layerColumns() const
{
  return nodes_->columns();
}

void Residency::request(const std::vector<LoadRequest>& requests)
{
  if (nodes_->request(requests))
  {
    nodes_->budget().announceChange();
    scheduler_->loadWithoutThreads();
  }
}

void Residency::release(const std::function<std::uint32_t(NodeIndex)>& distance)
{
  scheduler_->release(*nodes_, distance);
}

std::shared_ptr<const NodeColumns> Residency::find(NodeIndex node) const
{
  return nodes_->find(node);
}

ResidencySnapshot::State Residency::state(NodeIndex node) const
{
  return nodes_->state(node);
}

std::uint64_t Residency::revision() const
{
  return nodes_->revision();
}

bool Residency::exhausted() const
{
  return nodes_->exhausted();
}

void Residency::setArrivalFunction(std::function<void()> arrived)
{
  nodes_->setArrivalFunction(std::move(arrived));
}

std::uint64_t Residency::arrivals() const
{
  return nodes_->arrivals();
}

void Residency::waitUntilIdle() const
{
  waitUntil(*nodes_, [] { return false; });
}

void Residency::waitForArrival(std::uint64_t seen) const
{
  waitUntil(*nodes_, [&] { return nodes_->arrivals() != seen; });
}

void Residency::waitForArrival(std::uint64_t seen, std::chrono::milliseconds most) const
{
  const auto end = std::chrono::steady_clock::now() + most;
  std::uint64_t change = nodes_->budget().changes();
  while (nodes_->arrivals() == seen && !nodes_->idle() && std::chrono::steady_clock::now() < end)
  {
    nodes_->budget().waitForChange(change, end);
    change = nodes_->budget().changes();
  }
}

bool Residency::idle() const
{
  return nodes_->idle();
}

std::vector<Error> Residency::takeErrors()
{
  return nodes_->takeErrors();
}

ResidencyStatistics Residency::statistics() const
{
  return nodes_->statistics();
}

void Residency::setBudgetBytes(std::size_t bytes)
{
  nodes_->budget().setLimit(bytes);
  nodes_->reconsider();
  nodes_->budget().announceChange();
}

std::size_t Residency::budgetBytes() const
{
  return nodes_->budget().limit();
}

double Residency::shareOfAll() const
{
  return scheduler_->shareOf(*nodes_);
}

} // namespace pointfront
