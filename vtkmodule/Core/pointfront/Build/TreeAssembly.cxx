#include "pointfront/Build/TreeAssembly.h"

#include "pointfront/Build/CpuClock.h"

#include <algorithm>
#include <chrono>

namespace pointfront
{
namespace
{
/// Entries of the file's order that may be finished ahead of its turn, for each thread.
constexpr std::uint32_t aheadPerThread = 3;
constexpr auto wakeInterval = std::chrono::milliseconds(50); // an Error elsewhere ends a wait
} // namespace

TreeAssembly::TreeAssembly(AssemblyPlan plan, StoreWriter& writer, WorkCrew& crew)
    : plan_(std::move(plan)), writer_(writer), crew_(crew), order_(postOrder(plan_.tree)),
      rank_(order_.size()), open_(order_.size())
{
  for (std::uint32_t i = 0; i < order_.size(); ++i)
  {
    rank_[order_[i]] = i;
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
  if (Result<void> done = crew_.run([this] { return work(); }); !done)
  {
    return done.error();
  }
  return std::move(roots_);
}

Result<void> TreeAssembly::work()
{
  const std::unique_ptr<TreeBuilder> builder = plan_.builder();
  std::uint32_t node = 0;
  while (takePart(node))
  {
    if (Result<void> done = buildPart(node, *builder); !done)
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
    if (rank_[partNodes_[nextPart_]] <= turn_ + aheadPerThread * crew_.threads())
    {
      node = partNodes_[nextPart_++];
      return true;
    }
    turnChanged_.wait_for(lock, wakeInterval);
  }
  return false;
}

Result<void> TreeAssembly::buildPart(std::uint32_t node, TreeBuilder& builder)
{
  const PartNode& part = plan_.tree[node];
  double loadSeconds = 0.0;
  Result<std::vector<std::byte>> records = [&]
  {
    const CpuStopwatch watch(loadSeconds);
    return plan_.load(part.part);
  }();
  if (!records)
  {
    return records.error();
  }
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    loadSeconds_ += loadSeconds;
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
    std::unique_lock<std::mutex> lock(mutex_);
    waiting_[rank_[node]] = builder.takeEmitted();
    if (parent == PartNode::none)
    {
      roots_[part.layer] = std::move(root);
    }
    else
    {
      open_[node] = std::move(subtree);
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
        const auto payload = writer_.append(node.payload);
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
  writing_ = false;
  return {};
}

void TreeAssembly::addSeconds(const TreeBuilder& builder)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  seconds_.sort += builder.seconds().sort;
  seconds_.sample += builder.seconds().sample;
  seconds_.encode += builder.seconds().encode;
}

} // namespace pointfront
