#include "pointfront/Build/PartialTrees.h"

#include <map>
#include <utility>

namespace pointfront
{
/// The store that one call of show() shows.
class PartialTrees::Snapshot final : public PartialStore
{
public:
  Snapshot(const PartialTrees& trees, FinishedSubtrees finished)
    : trees_(trees)
    , points_(trees.pointsOf(trees.progressOf(finished)))
    , finished_(std::move(finished))
  {
  }
  std::uint64_t pointsFinished() const override { return points_; }
  Result<void> write(const std::string& path, const MetadataRecord& record) override
  {
    return trees_.write(std::move(finished_), path, record);
  }

private:
  const PartialTrees& trees_;
  std::uint64_t points_;
  FinishedSubtrees finished_;
};

PartialTrees::PartialTrees(PartialTreesSite site, std::vector<PartNode> tree,
  const std::vector<std::byte>& sample, BuildWatch& watch)
  : site_(std::move(site))
  , tree_(std::move(tree))
  , sample_(tree_.size())
  , watch_(watch)
{
  for (std::size_t at = 0; at < sample.size(); at += site_.recordBytes)
  {
    const std::byte* record = sample.data() + at;
    const std::uint32_t node = site_.construction.nodeOf(record);
    if (node != PartNode::none)
    {
      sample_[node].insert(sample_[node].end(), record, record + site_.recordBytes);
    }
  }
}

void PartialTrees::show(FinishedSubtrees finished)
{
  Snapshot snapshot(*this, std::move(finished));
  watch_.show(snapshot);
}

PartialTrees::Progress PartialTrees::progressOf(const FinishedSubtrees& finished) const
{
  Progress progress;
  progress.covered.assign(tree_.size(), 0);
  progress.touched.assign(tree_.size(), 0);
  for (const FinishedSubtree& subtree : finished.subtrees)
  {
    progress.covered[subtree.node] = 1;
  }
  for (std::size_t i = 0; i < tree_.size(); ++i) // parents come before their children
  {
    const std::uint32_t parent = tree_[i].parent;
    if (parent != PartNode::none && progress.covered[parent] != 0)
    {
      progress.covered[i] = 1;
    }
  }
  for (std::size_t i = tree_.size(); i-- > 0;)
  {
    const std::uint32_t parent = tree_[i].parent;
    progress.touched[i] |= progress.covered[i];
    if (parent != PartNode::none)
    {
      progress.touched[parent] |= progress.touched[i];
    }
  }
  return progress;
}

std::uint64_t PartialTrees::pointsOf(const Progress& progress) const
{
  std::uint64_t points = 0;
  for (std::size_t i = 0; i < tree_.size(); ++i)
  {
    points += tree_[i].part != PartNode::none && progress.covered[i] != 0 ? tree_[i].count : 0;
  }
  return points;
}

/// A sample of each part that is not finished. Records of a node above parts go to the first of
/// them: where it is built does not matter as long as none of them is finished.
std::vector<std::vector<std::byte>> PartialTrees::sampleOf(const Progress& progress) const
{
  std::vector<std::vector<std::byte>> sample(tree_.size());
  for (std::size_t i = 0; i < tree_.size(); ++i)
  {
    if (progress.touched[i] != 0 || sample_[i].empty())
    {
      continue;
    }
    std::size_t part = i;
    while (tree_[part].part == PartNode::none)
    {
      part = tree_[part].children.front();
    }
    sample[part].insert(sample[part].end(), sample_[i].begin(), sample_[i].end());
  }
  return sample;
}

/// One run over the tree, from the leaves up.
class PartialTrees::Weaving
{
public:
  Weaving(const PartialTrees& trees, FinishedSubtrees finished, StoreWriter& writer)
    : site_(trees.site_)
    , tree_(trees.tree_)
    , progress_(trees.progressOf(finished))
    , sample_(trees.sampleOf(progress_))
    , writer_(writer)
    , builder_(site_.construction.partialBuilder(site_.emitter))
  {
    for (FinishedSubtree& subtree : finished.subtrees)
    {
      finished_[subtree.node] = std::move(subtree.subtree);
    }
  }

  Result<Trees> run()
  {
    Trees roots(site_.description.layers.size());
    for (std::uint32_t node = 0; node < tree_.size(); ++node)
    {
      if (tree_[node].parent != PartNode::none)
      {
        continue;
      }
      const bool closed = progress_.covered[node] != 0;
      OpenSubtree tree = closed ? std::move(finished_[node]) : subtree(node);
      roots[tree_[node].layer] = closed ? std::move(tree.root) : builder_->close(std::move(tree));
      append();
    }
    return outcome_ ? Result<Trees>(std::move(roots)) : Result<Trees>(outcome_.error());
  }

private:
  OpenSubtree subtree(std::uint32_t node)
  {
    if (progress_.covered[node] != 0)
    {
      OpenSubtree& finished = finished_[node];
      return finished.root ? site_.construction.reopened(std::move(finished)) : OpenSubtree();
    }
    OpenSubtree made;
    if (tree_[node].part != PartNode::none)
    {
      const std::size_t count = sample_[node].size() / site_.recordBytes;
      made = builder_->build(std::move(sample_[node]), count, node);
    }
    else
    {
      std::vector<OpenSubtree> children;
      for (const std::uint32_t child : childrenOf(node))
      {
        OpenSubtree open = subtree(child);
        if (open.root)
        {
          children.push_back(std::move(open));
        }
      }
      made = children.empty() ? OpenSubtree() : builder_->join(std::move(children), node);
    }
    append();
    return made;
  }

  std::vector<std::uint32_t> childrenOf(std::uint32_t node) const
  {
    std::vector<std::uint32_t> children = tree_[node].children;
    for (;;)
    {
      std::vector<std::uint32_t> deeper;
      for (const std::uint32_t child : children)
      {
        const bool kept = progress_.covered[child] != 0 || tree_[child].part != PartNode::none;
        const std::vector<std::uint32_t>& below = tree_[child].children;
        deeper.insert(deeper.end(), kept ? &child : below.data(),
          kept ? &child + 1 : below.data() + below.size());
      }
      if (deeper.size() > site_.construction.partialChildren() || deeper == children)
      {
        return children;
      }
      children = std::move(deeper);
    }
  }

  /// Writes what the builder has emitted; the nodes learn where that is.
  void append()
  {
    for (const EmittedNode& node : builder_->takeEmitted())
    {
      const auto payload = outcome_ ? writer_.append(node.payload) : outcome_.error();
      outcome_ = payload ? outcome_ : Result<void>(payload.error());
      node.node->payload = payload ? *payload : 0;
    }
  }

  const PartialTreesSite& site_;
  const std::vector<PartNode>& tree_;
  Progress progress_;
  std::vector<std::vector<std::byte>> sample_;
  StoreWriter& writer_;
  std::unique_ptr<TreeBuilder> builder_;
  std::map<std::uint32_t, OpenSubtree> finished_; // by node
  Result<void> outcome_;
};

Result<void> PartialTrees::write(
  FinishedSubtrees finished, const std::string& path, const MetadataRecord& record) const
{
  auto writer =
    StoreWriter::createReferring(path, site_.description.schema, std::move(finished.written));
  if (!writer)
  {
    return writer.error();
  }
  const auto roots = Weaving(*this, std::move(finished), **writer).run();
  if (!roots)
  {
    return roots.error();
  }
  const NodeTable table = nodeTable(*roots);
  StoreDescription description = site_.description;
  description.metadata.push_back(record);
  description.levels = table.levels;
  return (*writer)->commit(description, table.nodes, table.roots, table.payloads);
}

} // namespace pointfront
