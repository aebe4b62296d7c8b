#include "pointfront/Views/OtherPieces.h"

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

class OtherPieces::AllResident final : public ResidencySnapshot
{
public:
  State state(NodeIndex) const override { return State::Resident; }
  std::uint64_t revision() const override { return 1; }
};

OtherPieces::OtherPieces(std::shared_ptr<const HierarchyPiece> piece)
  : piece_(std::move(piece))
  , residents_(std::make_unique<AllResident>())
  , front_(std::make_unique<RenderFront>(piece_->whole()))
{
}

OtherPieces::~OtherPieces() = default;

void OtherPieces::update(const View& view, const FrontLimits& limits, double thresholdPx,
  const std::function<bool()>& waits)
{
  FrontLimits all; // no budgets: they are in the threshold
  all.layers = limits.layers;
  all.targetErrorPx = thresholdPx;
  all.initialErrorPx = thresholdPx;
  all.movesPerFrame = movesOfUpdate;
  all.prefetchSiblings = false;
  const Hierarchy& whole = *piece_->whole();
  const FrontDelta* delta = nullptr;
  for (int i = 0; i < mostUpdates && (!delta || !delta->complete); ++i)
  {
    const std::uint64_t rows = whole.arrivals();
    delta = &front_->update(view, *residents_, all);
    if (delta->rowsComing)
    {
      const auto news = [&]
      {
        return whole.arrivals() != rows ||
          !whole.waitForArrival(rows, std::chrono::steady_clock::now() + betweenQuestions) ||
          whole.arrivals() != rows;
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
  if (delta->number == seen_)
  {
    return;
  }
  seen_ = delta->number;
  drawn_.clear();
  for (const DrawItem& item : delta->draw)
  {
    Node row;
    if (!piece_->has(item.node) && whole.peek(item.node, row) == RowState::Here)
    {
      drawn_.push_back({ item, row });
    }
  }
  std::sort(drawn_.begin(), drawn_.end(),
    [](const Drawn& a, const Drawn& b) { return a.item.node < b.item.node; });
}

} // namespace pointfront
