#include "pointfront/Build/OctreeAssembly.h"

#include "pointfront/Build/CpuClock.h"

#include <chrono>

namespace pointfront
{
namespace
{
/// Entries of the file's order that may be finished ahead of its turn, for each thread.
constexpr std::uint32_t aheadPerThread = 3;
constexpr auto wakeInterval = std::chrono::milliseconds(50); // an Error elsewhere ends a wait
} // namespace

OctreeAssembly::OctreeAssembly(const PartPool& parts, const NodeEmitter& emitter,
  const SamplingRule& rule, std::size_t recordBytes, StoreWriter& writer, WorkCrew& crew)
    : parts_(parts), emitter_(emitter), rule_(rule), recordBytes_(recordBytes), writer_(writer),
      crew_(crew), order_(parts.partition().postOrder()), rank_(order_.size()), open_(order_.size())
{
  const std::vector<Partition::Node>& nodes = parts.partition().nodes();
  for (std::uint32_t i = 0; i < order_.size(); ++i)
  {
    rank_[order_[i]] = i;
    if (nodes[order_[i]].part != Partition::none)
    {
      partNodes_.push_back(order_[i]);
    }
  }
  for (const Partition::Node& node : nodes)
  {
    missing_.push_back(static_cast<std::uint8_t>(node.children.size()));
  }
}

Result<std::unique_ptr<BuiltNode>> OctreeAssembly::run()
{
  if (Result<void> done = crew_.run([this] { return work(); }); !done)
  {
    return done.error();
  }
  return std::move(root_);
}

Result<void> OctreeAssembly::work()
{
  SubsetSampler sampler;
  std::uint32_t node = 0;
  while (takePart(node))
  {
    if (Result<void> done = buildPart(node, sampler); !done)
    {
      return done;
    }
  }
  return {};
}

bool OctreeAssembly::takePart(std::uint32_t& node)
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

Result<void> OctreeAssembly::buildPart(std::uint32_t node, SubsetSampler& sampler)
{
  const Partition::Node& part = parts_.partition().nodes()[node];
  Result<std::vector<std::byte>> records = parts_.load(part.part);
  if (!records)
  {
    return records.error();
  }
  SubtreeBuilder builder(emitter_, rule_, recordBytes_, sampler);
  OpenSubtree subtree = builder.build(std::move(*records), part.count);
  for (;;)
  {
    const std::uint32_t parent = parts_.partition().nodes()[node].parent;
    std::unique_ptr<BuiltNode> root;
    if (parent == Partition::none)
    {
      root = builder.close(std::move(subtree));
    }
    std::unique_lock<std::mutex> lock(mutex_);
    waiting_[rank_[node]] = builder.takeEmitted();
    if (parent == Partition::none)
    {
      root_ = std::move(root);
    }
    else
    {
      open_[node] = std::move(subtree);
    }
    const bool last = parent != Partition::none && --missing_[parent] == 0;
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
  addSeconds(builder);
  crew_.advance(part.count);
  return {};
}

OpenSubtree OctreeAssembly::joinChildren(std::uint32_t node, SubtreeBuilder& builder)
{
  const Partition::Node& joined = parts_.partition().nodes()[node];
  std::vector<OpenSubtree> children;
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const std::uint32_t child : joined.children)
    {
      children.push_back(std::move(open_[child]));
    }
  }
  return builder.join(std::move(children), joined.cell.log2Side);
}

Result<void> OctreeAssembly::writeInTurn()
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

void OctreeAssembly::addSeconds(const SubtreeBuilder& builder)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  seconds_.sort += builder.seconds().sort;
  seconds_.sample += builder.seconds().sample;
  seconds_.encode += builder.seconds().encode;
}

} // namespace pointfront
