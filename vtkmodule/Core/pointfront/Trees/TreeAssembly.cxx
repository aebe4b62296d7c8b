#include "pointfront/Trees/TreeAssembly.h"

#include "pointfront/Base/CpuClock.h"

#include <algorithm>
#include <chrono>
#include <optional>

namespace pointfront
{
namespace
{
/// Entries of the file's order that may be finished ahead of its turn, for each thread.
constexpr std::uint32_t aheadPerThread = 3;
constexpr auto wakeInterval = std::chrono::milliseconds(50); // an Error elsewhere ends a wait

std::unique_ptr<BuiltNode> copyOf(const BuiltNode& node)
{
  auto copy = std::make_unique<BuiltNode>();
  copy->row = node.row;
  copy->samplingQuarters = node.samplingQuarters;
  copy->payload = node.payload;
  for (const auto& child : node.children)
  {
    copy->children.push_back(copyOf(*child));
  }
  return copy;
}
} // namespace

TreeAssembly::TreeAssembly(
  AssemblyPlan plan, StoreWriter& writer, WorkCrew& crew, AssemblyWatch* watch)
  : plan_(std::move(plan))
  , writer_(writer)
  , crew_(crew)
  , watch_(watch)
  , order_(postOrder(plan_.tree))
  , turns_(order_.size())
  , open_(order_.size())
{
  for (std::uint32_t i = 0; i < order_.size(); ++i)
  {
    turns_[order_[i]] = i;
    if (plan_.tree[order_[i]].part != PartNode::none)
    {
      partNodes_.push_back(order_[i]);
    }
  }
  for (const PartNode& node : plan_.tree)
  {
    missing_.push_back(static_cast<std::uint8_t>(node.children.size()));
    roots_.resize(std::max<std::size_t>(roots_.size(), node.layer + 1u));
  }
}

Result<std::vector<std::unique_ptr<BuiltNode>>> TreeAssembly::run()
{
  std::vector<std::uint32_t> order;
  for (const std::uint32_t node : partNodes_)
  {
    order.push_back(plan_.tree[node].part);
  }
  ReadAhead parts(std::move(order), plan_.load, plan_.readAhead);
  const Result<void> done = crew_.run([&] { return work(parts); });
  loadSeconds_ = parts.seconds();
  if (!done)
  {
    return done.error();
  }
  return std::move(roots_);
}

Result<void> TreeAssembly::work(ReadAhead& parts)
{
  const std::unique_ptr<TreeBuilder> builder = plan_.builder();
  std::uint32_t node = 0;
  while (takePart(node))
  {
    if (Result<void> done = buildPart(node, parts, *builder); !done)
    {
      return done;
    }
  }
  addSeconds(*builder);
  return {};
}

bool TreeAssembly::takePart(std::uint32_t& node)
{
  std::unique_lock<std::mutex> lock(mutex_);
  while (!crew_.stopped() && nextPart_ < partNodes_.size())
  {
    if (turns_[partNodes_[nextPart_]] <= turn_ + aheadPerThread * crew_.threads())
    {
      node = partNodes_[nextPart_++];
      return true;
    }
    turnChanged_.wait_for(lock, wakeInterval);
  }
  return false;
}

Result<void> TreeAssembly::buildPart(std::uint32_t node, ReadAhead& parts, TreeBuilder& builder)
{
  const PartNode& part = plan_.tree[node];
  ReadAhead::Records records = parts.take(part.part);
  if (!records)
  {
    return records.error();
  }
  OpenSubtree subtree = builder.build(std::move(*records), part.count, node);
  for (;;)
  {
    const std::uint32_t parent = plan_.tree[node].parent;
    std::unique_ptr<BuiltNode> root;
    if (parent == PartNode::none)
    {
      root = builder.close(std::move(subtree));
    }
    std::vector<EmittedNode> emitted = builder.takeEmitted();
    for (EmittedNode& each : emitted)
    {
      each.pointsAround = each.node == root.get() ? UINT64_MAX : each.pointsAround;
    }
    std::unique_lock<std::mutex> lock(mutex_);
    waiting_[turns_[node]] = std::move(emitted);
    if (parent == PartNode::none)
    {
      roots_[part.layer] = std::move(root);
    }
    else
    {
      open_[node] = std::move(subtree); // NOLINT(bugprone-use-after-move): above, the other case
    }
    const bool last = parent != PartNode::none && --missing_[parent] == 0;
    lock.unlock();
    if (Result<void> done = writeInTurn(); !done)
    {
      return done;
    }
    if (!last)
    {
      break;
    }
    subtree = joinChildren(parent, builder); // whoever finishes the last child joins them
    node = parent;
  }
  crew_.advance(part.count);
  return {};
}

OpenSubtree TreeAssembly::joinChildren(std::uint32_t node, TreeBuilder& builder)
{
  std::vector<OpenSubtree> children;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const std::uint32_t child : plan_.tree[node].children)
    {
      children.push_back(std::move(open_[child]));
    }
  }
  return builder.join(std::move(children), node);
}

Result<void> TreeAssembly::writeInTurn()
{
  std::unique_lock<std::mutex> lock(mutex_);
  if (writing_)
  {
    return {}; // that thread will see what was added
  }
  writing_ = true;
  while (!waiting_.empty() && waiting_.begin()->first == turn_)
  {
    std::vector<EmittedNode> emitted = std::move(waiting_.begin()->second);
    waiting_.erase(waiting_.begin());
    lock.unlock();
    double seconds = 0.0;
    {
      const CpuStopwatch watch(seconds);
      for (const EmittedNode& node : emitted)
      {
        const auto payload = node.pointsAround >= plan_.lateFrom ? writer_.appendLate(node.payload)
                                                                 : writer_.append(node.payload);
        if (!payload)
        {
          return payload.error(); // the crew stops: nobody waits for `writing_`
        }
        node.node->payload = *payload;
      }
    }
    lock.lock();
    writeSeconds_ += seconds;
    ++turn_;
    turnChanged_.notify_all();
  }
  return letWatch(lock);
}

/// Called by who wrote, before another may. A watch sees the trees only while the next in turn is a
/// part that is not finished: then nobody joins what stands before it, for want of that part.
Result<void> TreeAssembly::letWatch(std::unique_lock<std::mutex>& lock)
{
  std::optional<FinishedSubtrees> shown;
  const bool settled = turn_ < order_.size() && plan_.tree[order_[turn_]].part != PartNode::none;
  if (watch_ && settled && turn_ > shown_ && !watched_)
  {
    const std::vector<std::uint32_t> nodes = writtenSubtrees();
    std::size_t held = 0;
    for (const std::uint32_t node : nodes)
    {
      held += open_[node].records.size();
    }
    if (watch_->due(held))
    {
      auto done = finished(nodes);
      if (!done)
      {
        return done.error();
      }
      shown = std::move(*done);
      shown_ = turn_;
    }
  }
  writing_ = false;
  if (shown)
  {
    watched_ = true;
    lock.unlock();
    watch_->show(std::move(*shown));
    lock.lock();
    watched_ = false;
  }
  return {};
}

/// The largest subtrees of which all is written.
std::vector<std::uint32_t> TreeAssembly::writtenSubtrees() const
{
  std::vector<std::uint32_t> nodes;
  for (std::uint32_t i = 0; i < turn_; ++i)
  {
    const std::uint32_t parent = plan_.tree[order_[i]].parent;
    if (parent == PartNode::none || turns_[parent] >= turn_)
    {
      nodes.push_back(order_[i]);
    }
  }
  return nodes;
}

Result<FinishedSubtrees> TreeAssembly::finished(const std::vector<std::uint32_t>& nodes)
{
  FinishedSubtrees result;
  for (const std::uint32_t node : nodes)
  {
    const PartNode& place = plan_.tree[node];
    const bool closed = place.parent == PartNode::none;
    const BuiltNode* root = closed ? roots_[place.layer].get() : open_[node].root.get();
    if (root)
    {
      result.subtrees.push_back({ node, { copyOf(*root), open_[node].records } });
    }
  }
  auto written = writer_.written();
  if (!written)
  {
    return written.error();
  }
  result.written = std::move(*written);
  return result;
}

void TreeAssembly::addSeconds(const TreeBuilder& builder)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  seconds_.sort += builder.seconds().sort;
  seconds_.sample += builder.seconds().sample;
  seconds_.encode += builder.seconds().encode;
}

} // namespace pointfront
