#include "StoreSuccession.h"

#include "pointfront/Store/StoredCloud.h"

#include <algorithm>

namespace pointfront
{

StoreSuccession::StoreSuccession(
  vtkSmartPointer<vtkPointFrontStore> successor, vtkPointFrontStore& preview, int piece, int pieces)
  : store_(std::move(successor))
  , piece_(std::make_shared<HierarchyPiece>(store_->GetStore()->hierarchy(), piece, pieces))
{
  store_->SetHostMemoryBudget(preview.GetHostMemoryBudget());
}

void StoreSuccession::advance(const RendererFront* view, FrameRequest request)
{
  const AttributeSchema& schema = store_->GetStore()->description().schema;
  std::unique_ptr<ViewFront>& front = fronts_[view];
  if (!front)
  {
    front = std::make_unique<ViewFront>(piece_, store_->GetResidencyShare(), schema,
      std::make_shared<WindowDemand>()); // not in the window yet: it takes nothing from the others
  }
  // Its layers may be others: each gets what any of the preview's has.
  ColumnSelection columns = request.columns.any();
  const auto unknown = std::remove_if(
    columns.begin(), columns.end(), [&](std::uint32_t column) { return column >= schema.size(); });
  columns.erase(unknown, columns.end());
  request.columns = columns;
  front->update(request);
}

bool StoreSuccession::ready(const RendererFront* view) const
{
  const auto front = fronts_.find(view);
  return front != fronts_.end() && front->second->last().complete;
}

bool StoreSuccession::wantsUpdate() const
{
  return std::any_of(fronts_.begin(), fronts_.end(),
    [](const auto& entry) { return entry.second->wantsUpdate() || entry.second->last().complete; });
}

std::unique_ptr<ViewFront> StoreSuccession::take(const RendererFront* view)
{
  const auto front = fronts_.find(view);
  return front != fronts_.end() ? std::move(front->second) : nullptr;
}

} // namespace pointfront
