#include "pointfront/Views/WholeFront.h"

#include "pointfront/Detail/ViewDetail.h"
#include "pointfront/Front/RenderFront.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace pointfront
{
namespace
{

constexpr std::uint32_t movesOfUpdate = 1u << 20;
/// The threshold falls by a fifth an update: from any to any other it takes far fewer.
constexpr int mostUpdates = 256;
/// Whether to go on waiting.
constexpr std::chrono::milliseconds betweenQuestions{ 50 };

} // namespace

class WholeFront::AllResident final : public ResidencySnapshot
{
public:
  State state(NodeIndex) const override { return State::Resident; }
  std::uint64_t revision() const override { return 1; }
};

WholeFront::WholeFront(std::shared_ptr<const Hierarchy> hierarchy, Selection selection)
  : hierarchy_(std::move(hierarchy))
  , selection_(selection)
  , residents_(std::make_unique<AllResident>())
{
  if (selection == Selection::ViewSpecific)
  {
    front_ = std::make_unique<ViewDetail>(hierarchy_);
  }
  else
  {
    front_ = std::make_unique<RenderFront>(hierarchy_);
  }
}

WholeFront::~WholeFront() = default;

FrontLimits WholeFront::limitsOf(const FrontLimits& limits, double thresholdPx) const
{
  FrontLimits all; // no budgets: they are in the threshold
  all.layers = limits.layers;
  if (selection_ == Selection::ViewSpecific)
  {
    all = limits;
  }
  all.targetErrorPx = thresholdPx;
  all.initialErrorPx = thresholdPx;
  all.movesPerFrame = movesOfUpdate;
  all.prefetchSiblings = false;
  return all;
}

const FrontDelta& WholeFront::update(const View& view, const FrontLimits& limits,
  double thresholdPx, const std::function<bool()>& waits)
{
  const FrontLimits all = limitsOf(limits, thresholdPx);
  delta_ = nullptr;
  for (int i = 0; i < mostUpdates && (!delta_ || !delta_->complete); ++i)
  {
    const std::uint64_t rows = hierarchy_->arrivals();
    delta_ = &front_->update(view, *residents_, all);
    if (delta_->rowsComing)
    {
      const auto news = [&]
      {
        return hierarchy_->arrivals() != rows ||
          !hierarchy_->waitForArrival(rows, std::chrono::steady_clock::now() + betweenQuestions) ||
          hierarchy_->arrivals() != rows;
      };
      bool goesOn = waits && waits();
      while (goesOn && !news())
      {
        goesOn = waits();
      }
      if (!goesOn)
      {
        break;
      }
    }
  }
  return *delta_;
}

std::vector<TabledNode> WholeFront::drawn(const std::function<bool(NodeIndex)>& wanted) const
{
  std::vector<TabledNode> nodes;
  for (const DrawItem& item : delta_->draw)
  {
    Node row;
    if (wanted(item.node) && hierarchy_->peek(item.node, row) == RowState::Here)
    {
      nodes.push_back({ item, row });
    }
  }
  std::sort(nodes.begin(), nodes.end(),
    [](const TabledNode& a, const TabledNode& b) { return a.item.node < b.item.node; });
  return nodes;
}

} // namespace pointfront
