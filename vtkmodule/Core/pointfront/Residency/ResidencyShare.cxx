#include "pointfront/Residency/ResidencyShare.h"

#include <algorithm>
#include <limits>

namespace pointfront
{

ResidencyShare::Wish::Wish(ResidencyShare& share)
  : share_(share)
{
}

ResidencyShare::Wish::~Wish()
{
  auto& all = share_.wishes_;
  all.erase(std::remove(all.begin(), all.end(), this), all.end());
  share_.updateColumns();
  share_.updateRequests();
}

void ResidencyShare::Wish::setLayerColumns(const LayerColumns& columns)
{
  if (columns != columns_)
  {
    columns_ = columns;
    share_.updateColumns();
  }
}

void ResidencyShare::Wish::request(const std::vector<LoadRequest>& requests, Distance distance)
{
  requests_ = requests;
  distance_ = std::move(distance);
  share_.updateRequests();
}

ResidencyShare::ResidencyShare(
  std::shared_ptr<const NodeReader> reader, NodeIndex nodeCount, const ResidencyOptions& options)
  : residency_(std::move(reader), nodeCount, options)
{
}

ResidencyShare::ResidencyShare(std::shared_ptr<const NodeReader> reader, NodeIndex nodeCount,
  std::shared_ptr<LoadScheduler> scheduler, std::uint64_t points)
  : residency_(std::move(reader), nodeCount, std::move(scheduler), points)
{
}

ResidencyShare::~ResidencyShare() = default;

std::unique_ptr<ResidencyShare::Wish> ResidencyShare::join()
{
  std::unique_ptr<Wish> wish(new Wish(*this));
  wishes_.push_back(wish.get());
  return wish;
}

void ResidencyShare::updateColumns()
{
  LayerColumns all;
  for (const Wish* wish : wishes_)
  {
    all.add(wish->columns_);
  }
  // Without any front left nothing changes: what is loaded may be drawn again.
  if (!wishes_.empty() && all != residency_.layerColumns())
  {
    residency_.setLayerColumns(all);
  }
}

void ResidencyShare::updateRequests()
{
  if (wishes_.size() == 1)
  {
    residency_.request(wishes_.front()->requests_);
  }
  else
  {
    merged_.clear();
    for (const Wish* wish : wishes_)
    {
      for (const LoadRequest& r : wish->requests_)
      {
        const auto [place, first] = merged_.emplace(r.node, r);
        place->second.priority = std::max(place->second.priority, r.priority);
        place->second.optional = place->second.optional && r.optional;
      }
    }
    std::vector<LoadRequest> all;
    all.reserve(merged_.size());
    for (const auto& [node, request] : merged_)
    {
      all.push_back(request);
    }
    std::stable_sort(all.begin(), all.end(),
      [](const LoadRequest& a, const LoadRequest& b)
      { return a.optional != b.optional ? b.optional : a.priority > b.priority; });
    residency_.request(all);
  }
  residency_.release(
    [this](NodeIndex node)
    {
      std::uint32_t least = std::numeric_limits<std::uint32_t>::max();
      for (const Wish* wish : wishes_)
      {
        if (wish->distance_)
        {
          least = std::min(least, wish->distance_(node));
        }
      }
      return least;
    });
}

} // namespace pointfront
