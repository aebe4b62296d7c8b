#include "pointfront/Views/ViewFront.h"

#include "pointfront/Views/GpuSlotBytes.h"

#include "pointfront/Detail/ViewDetail.h"
#include "pointfront/Front/RenderFront.h"
#include "pointfront/Residency/LoadScheduler.h"

#include <algorithm>
#include <chrono>

namespace pointfront
{
namespace
{

/// Moves of a frame that nobody waits in: enough to finish a city in a few frames.
constexpr std::uint32_t movesAtRest = 4096;
/// Moves of an update inside a complete render.
constexpr std::uint32_t movesToComplete = 1u << 20;
/// Share of the memory budget for a view's nodes: some room stays for nodes being decoded.
constexpr double heldShare = 0.85;
/// Longest that a frame at rest goes on moving its front.
constexpr std::chrono::milliseconds restTime{ 10 };
/// Between two questions whether a complete frame is to go on waiting.
constexpr std::chrono::milliseconds betweenAborts{ 50 };
/// Fewest points of a frame in motion: less is no picture, whatever the machine.
constexpr std::uint64_t fewestPoints = 100000;
/// Moves of a front in a frame.
constexpr std::uint32_t fewestMoves = 8;

bool covers(const NodeColumns& node, const ColumnSelection& columns)
{
  return std::includes(
    node.selection.begin(), node.selection.end(), columns.begin(), columns.end());
}

} // namespace

ViewFront::ViewFront(std::shared_ptr<const HierarchyPiece> piece, ResidencyShare& share,
  const AttributeSchema& schema, std::shared_ptr<const WindowDemand> window)
  : piece_(std::move(piece))
  , share_(share)
  , schema_(schema)
  , wish_(share.join())
  , selection_(std::make_unique<RenderFront>(piece_->hierarchy()))
  , others_(piece_->isWhole() ? nullptr : std::make_unique<OtherPieces>(piece_))
  , margin_(piece_->hierarchy())
  , memory_(share.residency().scheduler().sharedDemand())
  , window_(std::make_unique<WindowClaims>(std::move(window)))
{
}

ViewFront::~ViewFront() = default;

void ViewFront::enterWindow(std::shared_ptr<const WindowDemand> window)
{
  window_ = std::make_unique<WindowClaims>(std::move(window));
  sharedSeen_ = 0;
  told_ = 0;
}

void ViewFront::leave()
{
  const DemandCurve nothing;
  memory_.set(nothing);
  window_->points.set(nothing);
  window_->slots.set(nothing);
  sharedSeen_ = 0;
  told_ = 0;
  wish_->request({}, [](NodeIndex) { return 1u; });
}

std::shared_ptr<const NodeColumns> ViewFront::find(NodeIndex node) const
{
  return share_.residency().find(node);
}

const FrontDelta& ViewFront::update(const FrameRequest& request)
{
  wish_->setLayerColumns(request.columns);
  covered_ = covered_ && columns_ == request.columns;
  columns_ = request.columns;
  const std::size_t pointBytes = largestPoint(share_.residency().layerColumns());
  told_ = pointBytes == pointBytes_ ? told_ : 0;
  pointBytes_ = pointBytes;
  choose(request.method);
  if (!begun_)
  {
    begun_ = true;
    loadRoots();
  }
  if (request.complete)
  {
    complete(request);
  }
  else
  {
    step(request);
    // At rest the threshold falls on at once until requests pile up (FRONT-7): no frame shows less
    // than what is loaded, and what is missing is asked for together, the largest errors first. One
    // update a drawing would ask for it in waves, each as long as a drawing. After a step without
    // a move there is one more: what another view had asked for may have kept the threshold.
    const auto begin = std::chrono::steady_clock::now();
    const auto inTime = [&] { return std::chrono::steady_clock::now() - begin < restTime; };
    bool moved = true;
    while (!request.interacting && !delta_.complete && (movedOn() ? inTime() : moved))
    {
      moved = movedOn();
      step(request);
    }
    noteColumns(request);
  }
  expect(request);
  if (others_ && method_ == DetailMethod::RenderingFront)
  {
    std::function<bool()> waits;
    if (request.complete && delta_.complete) // not where it was aborted
    {
      waits = [&request] { return !request.aborted || !request.aborted(); };
    }
    others_->update(request.view, limits_, delta_.thresholdPx, waits);
  }
  return delta_;
}

const std::vector<OtherPieces::Drawn>& ViewFront::drawnElsewhere() const
{
  static const std::vector<OtherPieces::Drawn> nothing;
  return others_ && method_ == DetailMethod::RenderingFront ? others_->drawn() : nothing;
}

/// Bytes of a decoded point of the layer that has most of them: whichever layers the view shows,
/// what is counted with it fits.
std::size_t ViewFront::largestPoint(const LayerColumns& columns) const
{
  const auto bytes = [&](const ColumnSelection& selection)
  {
    std::size_t sum = sizeof(glm::u32vec3);
    for (const std::uint32_t column : selection)
    {
      sum += schema_[column].bytes();
    }
    return sum;
  };
  std::size_t most = columns.layers.empty() ? bytes(columns.others) : 0;
  for (const ColumnSelection& layer : columns.layers)
  {
    most = std::max(most, bytes(layer));
  }
  return most;
}

/// Nothing that is loaded is lost by it: what the other needs as well stays.
void ViewFront::choose(DetailMethod method)
{
  if (method == method_)
  {
    return;
  }
  method_ = method;
  expected_.reset();
  told_ = 0;
  // The wish's distance function asks the selection that is there when it is called.
  if (method == DetailMethod::ViewSpecific)
  {
    selection_ = std::make_unique<ViewDetail>(piece_->hierarchy());
  }
  else
  {
    selection_ = std::make_unique<RenderFront>(piece_->hierarchy());
  }
}

bool ViewFront::movedOn() const
{
  return delta_.moves > 0 || delta_.thresholdPx != thresholdBefore_;
}

void ViewFront::loadRoots()
{
  Residency& residency = share_.residency();
  std::vector<LoadRequest> roots;
  for (const NodeIndex root : piece_->hierarchy()->roots())
  {
    const Node row = piece_->hierarchy()->node(root); // roots stay in memory
    const std::uint32_t points = row.pointCount;
    if (points > 0)
    {
      roots.push_back({ root, 1e9, false, points, row.layer });
    }
  }
  const auto missing = [&](const LoadRequest& r)
  { return residency.state(r.node) == ResidencySnapshot::State::Absent; };
  const auto begin = std::chrono::steady_clock::now();
  const std::chrono::milliseconds rootTime = window_->window->roots->allowance(begin);
  const auto end = begin + rootTime;
  bool waits = true; // false: no room for them in the budget; the frame says what it can draw
  while (waits && std::any_of(roots.begin(), roots.end(), missing) &&
    std::chrono::steady_clock::now() < end)
  {
    wish_->request(roots, [](NodeIndex) { return 0u; }); // frees memory for them, too
    const std::uint64_t seen = residency.arrivals();
    residency.waitForArrival(seen, rootTime);
    const ResidencyStatistics now = residency.statistics();
    waits = residency.arrivals() != seen || now.loading > 0 ||
      (now.pending > 0 && !residency.exhausted());
  }
  window_->window->roots->spend(begin, std::chrono::steady_clock::now());
}

/// Reads the demand of the other views, for the memory and the window. Where this update may draw
/// fewer points than the last one, as when a motion begins, those who are yet to come down do not
/// count with what they have on screen (SharedDemand).
void ViewFront::readShares(const FrameRequest& request)
{
  const LoadScheduler& scheduler = share_.residency().scheduler();
  const std::uint64_t revision = sharedRevision();
  const std::uint64_t points = limits_.sharedDrawn.most;
  const bool otherBudgets = points != pointBudgetSeen_ || request.gpuBytes != gpuBytesSeen_;
  if (revision != sharedSeen_ || otherBudgets)
  {
    sharedSeen_ = revision;
    told_ = otherBudgets ? 0 : told_;
    pointBudgetSeen_ = points;
    gpuBytesSeen_ = request.gpuBytes;
    window_->points.elsewhere(elsewhere_.drawn, points);
    window_->slots.elsewhere(elsewhere_.slots, static_cast<std::uint64_t>(request.gpuBytes));
    memory_.elsewhere(elsewhere_.held);
    for (std::size_t step = 0; step < DemandCurve::size; ++step)
    {
      elsewhere_.held[step] /= pointBytes_;
    }
  }
  limits_.sharedRevision = revision;
  limits_.sharedDrawn.elsewhere = &elsewhere_.drawn;
  limits_.sharedSlots.elsewhere = &elsewhere_.slots;
  limits_.sharedHeld.elsewhere = &elsewhere_.held;
  limits_.sharedHeld.most = static_cast<std::uint64_t>(heldShare *
    static_cast<double>(scheduler.budget()->limit()) / static_cast<double>(pointBytes_));
}

/// Tells the others this view's demand.
void ViewFront::tellDemand(const FrameRequest& request)
{
  DemandCurves curves;
  selection_->demandCurves(curves);
  for (std::size_t step = 0; step < DemandCurve::size; ++step)
  {
    curves.held[step] *= pointBytes_;
  }
  // This view's own changes are no news to itself. Changes of others since readShares() are.
  const std::uint64_t before = sharedRevision();
  memory_.set(curves.held);
  window_->points.set(curves.drawn, limits_.sharedDrawn.most);
  window_->slots.set(curves.slots, static_cast<std::uint64_t>(request.gpuBytes));
  sharedSeen_ += sharedRevision() - before;
}

void ViewFront::setLimits(const FrameRequest& request)
{
  FrontLimits& limits = limits_;
  limits.targetErrorPx = request.targetErrorPx;
  limits.pointBudget = request.pointBudget;
  limits.layers = request.layers;
  limits.sharedDrawn.most = request.pointBudget;
  const std::uint64_t claims = window_->points.claims();
  limits.sharedSlots.most = request.gpuBytes > 0
    ? GpuSlotBytes::slotsWithin(request.gpuBytes, request.gpuStreams, claims)
    : 0;
  limits.requestLimit = mostRequests;
  limits.interacting = request.interacting;
  limits.motionErrorPx = request.targetErrorPx;
  limits.movesPerFrame = request.complete ? movesToComplete : movesAtRest;
  limits.prefetchSiblings = !request.complete;
  limits.overviewPoints = request.overviewPoints;
  limits.heldPointBudget =
    static_cast<std::uint64_t>(heldShare * static_cast<double>(share_.budgetBytes()) /
      static_cast<double>(pointBytes_ * std::max<std::size_t>(1, share_.wishes())));
  const auto clouds = static_cast<double>(claims);
  const double frameMs = request.frameMs > 0.0 ? request.frameMs : clouds * request.cloudMs;
  if (request.interacting && frameMs > 0.0)
  {
    // All clouds share them, at one error.
    const WindowCost& cost = *window_->window->cost;
    const bool still = request.view == motionView_ && frameMs == motionMs_;
    motionView_ = request.view;
    motionMs_ = frameMs;
    const std::uint64_t all =
      std::max(motionPoints_.next(cost.pointsFor(frameMs, fewestPoints), still), cost.heldPoints());
    const std::uint64_t affordable =
      std::max<std::uint64_t>(fewestPoints, all - std::min(cost.beside(), 2 * all / 5));
    std::uint64_t& most = clouds > 1.0 ? limits.sharedDrawn.most : limits.pointBudget;
    most = request.pointBudget == 0 ? affordable : std::min(request.pointBudget, affordable);
    const auto moves = static_cast<double>(cost.movesFor(frameMs)) / clouds;
    limits.movesPerFrame = std::max(fewestMoves, static_cast<std::uint32_t>(moves));
  }
  else
  {
    motionMs_ = 0.0;
  }
  readShares(request);
}

/// Where nothing has changed nothing is told nor asked for: a still view costs next to nothing,
/// however many there are.
void ViewFront::step(const FrameRequest& request)
{
  thresholdBefore_ = delta_.thresholdPx;
  arrivalsSeen_ = share_.residency().arrivals();
  rowsSeen_ = piece_->hierarchy()->arrivals();
  setLimits(request);
  const FrontDelta& made = selection_->update(request.view, share_.residency(), limits_);
  const bool sameAgain = made.number == told_ && !request.interacting;
  if (sameAgain && !marginGoesOn())
  {
    delta_.complete = made.complete;
    return;
  }
  covered_ = false;
  marginWalks_ = sameAgain ? marginWalks_ : 0;
  told_ = request.interacting ? 0 : made.number; // in motion it has a margin that goes at rest
  delta_ = made;
  tellDemand(request);
  addMargin(request);
  wish_->request(
    delta_.requests, [this](NodeIndex node) { return selection_->distanceUnderFront(node); });
}

bool ViewFront::allCovered() const
{
  return std::all_of(delta_.draw.begin(), delta_.draw.end(),
    [&](const DrawItem& item)
    {
      const auto node = share_.residency().find(item.node);
      return node && covers(*node, columns_.of(node->layer));
    });
}

/// A view at rest is not complete while what it draws is read again with the columns that a new
/// colour or filter wants: until then those points are drawn without, or not at all.
void ViewFront::noteColumns(const FrameRequest& request)
{
  if (!delta_.complete || request.interacting || covered_)
  {
    return;
  }
  covered_ = allCovered();
  const Residency& residency = share_.residency();
  const ResidencyStatistics now = residency.statistics();
  const bool coming = residency.arrivals() != arrivalsSeen_ || now.loading > 0 ||
    (now.pending > 0 && !residency.exhausted());
  delta_.complete = covered_ || !coming;
}

/// Waits for rows of the table if those are missing, or else for nodes. False: aborted, or there is
/// no memory to load with.
bool ViewFront::waitForNews(const FrameRequest& request)
{
  const Residency& residency = share_.residency();
  const Hierarchy& table = *piece_->hierarchy();
  const auto arrived = [&]
  {
    return delta_.rowsComing ? table.arrivals() != rowsSeen_
                             : residency.arrivals() != arrivalsSeen_ || residency.idle();
  };
  while (!arrived())
  {
    if ((request.aborted && request.aborted()) || residency.scheduler().starving())
    {
      return false;
    }
    if (!delta_.rowsComing)
    {
      residency.waitForArrival(arrivalsSeen_, betweenAborts);
    }
    else if (!table.waitForArrival(rowsSeen_, std::chrono::steady_clock::now() + betweenAborts))
    {
      break;
    }
  }
  return true;
}

void ViewFront::complete(const FrameRequest& request)
{
  Residency& residency = share_.residency();
  int idle = 0;
  while (idle < 2)
  {
    step(request);
    if (delta_.complete && allCovered())
    {
      return;
    }
    const bool moved = movedOn();
    if ((delta_.rowsComing || !moved) && !waitForNews(request))
    {
      delta_.complete = false;
      told_ = 0;
      return;
    }
    if (delta_.rowsComing)
    {
      continue;
    }
    // Twice nothing new and nothing under way: the memory budget holds no more of this view.
    idle = moved || residency.arrivals() != arrivalsSeen_ ? 0 : idle + 1;
  }
  delta_.complete = true;
}

std::uint64_t ViewFront::pointsOnGpu(std::uint64_t windowBudget) const
{
  DemandCurve others;
  window_->points.elsewhere(others);
  const std::uint64_t drawn = delta_.pointsDrawn + others[0];
  const std::uint64_t idle = windowBudget > drawn ? windowBudget - drawn : 0;
  return delta_.pointsDrawn + idle / window_->points.claims();
}

bool ViewFront::expectsMore() const
{
  const ResidencyStatistics now = share_.residency().statistics();
  return !delta_.complete &&
    (delta_.rowsComing || now.loading > 0 || (now.pending > 0 && !share_.residency().exhausted()));
}

/// All that this view asks for is there: what arrives now is another's, or was seen before the
/// update counted it.
bool ViewFront::isSettled() const
{
  return delta_.complete && !delta_.limitedByMemory && !limits_.interacting && allCovered();
}

bool ViewFront::wantsUpdate() const
{
  return !begun_ || (share_.residency().arrivals() != arrivalsSeen_ && !isSettled()) ||
    sharedRevision() != sharedSeen_ ||
    ((delta_.rowsComing || marginGoesOn()) && piece_->hierarchy()->arrivals() != rowsSeen_) ||
    (!delta_.complete && movedOn());
}

} // namespace pointfront
