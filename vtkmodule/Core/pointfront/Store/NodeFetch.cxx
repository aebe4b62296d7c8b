#include "pointfront/Codec/Checksum.h"
#include "pointfront/Store/PointStore.h"
#include "pointfront/Store/StoreContent.h"
#include "pointfront/Store/StoreWriter.h"

#include <cassert>
#include <numeric>
#include <optional>
#include <string>
#include <utility>

namespace pointfront
{
namespace
{
/// A node on its way: what has gone wrong with it, or what it has so far.
struct Step
{
  FetchedNode fetched;
  std::optional<Error> error;
};

Result<FetchedNode> resultOf(Step step)
{
  return step.error ? Result<FetchedNode>(std::move(*step.error))
                    : Result<FetchedNode>(std::move(step.fetched));
}

/// Reads for several nodes with one call.
class NodeReads
{
public:
  NodeReads(const ByteSource& file, const ReadStop& stop)
    : file_(file)
    , stop_(stop)
  {
  }
  /// Ranges of the same step come one after another.
  std::vector<ByteRange>& of(Step& step)
  {
    if (steps_.empty() || steps_.back().first != &step)
    {
      steps_.push_back({ &step, ranges_.size() });
    }
    return ranges_;
  }
  /// An error is that of all, unless it tells of a place: then each node reads for itself.
  void run()
  {
    const Result<void> done =
      ranges_.empty() ? Result<void>() : file_.readUntil(stop_, ranges_.data(), ranges_.size());
    for (std::size_t s = 0; !done && s < steps_.size(); ++s)
    {
      const auto& [step, first] = steps_[s];
      const std::size_t end = s + 1 < steps_.size() ? steps_[s + 1].second : ranges_.size();
      if (done.error().kind != Error::Kind::Truncated || steps_.size() == 1)
      {
        step->error = done.error();
      }
      else if (Result<void> alone = file_.readUntil(stop_, ranges_.data() + first, end - first);
               !alone)
      {
        step->error = alone.error();
      }
    }
  }

private:
  const ByteSource& file_;
  const ReadStop& stop_;
  std::vector<ByteRange> ranges_;
  std::vector<std::pair<Step*, std::size_t>> steps_; ///< with the first of their ranges
};
} // namespace

std::vector<Result<FetchedNode>> NodeReader::fetchAll(
  const std::vector<WantedNode>& wanted, const ReadStop& stop) const
{
  std::vector<Result<FetchedNode>> fetched;
  fetched.reserve(wanted.size());
  for (const WantedNode& want : wanted)
  {
    fetched.push_back(stop ? makeError(Error::Kind::Cancelled,
                               "nobody wants node " + std::to_string(want.node) + " now")
                           : fetch(want.node, want.columns));
  }
  return fetched;
}

Result<FetchedNode> PointStore::fetch(NodeIndex node, const ColumnSelection& columns) const
{
  const ReadStop never{ false };
  return std::move(fetchAll({ { node, columns } }, never).front());
}

std::vector<Result<FetchedNode>> PointStore::fetchAll(
  const std::vector<WantedNode>& wanted, const ReadStop& stop) const
{
  const Content& content = *content_;
  std::vector<Step> steps(wanted.size());
  NodeReads records(*content.file, stop);
  for (std::size_t i = 0; i < wanted.size(); ++i)
  {
    Step& step = steps[i];
    const NodeIndex node = wanted[i].node;
    assert(node < content.hierarchy->nodeCount());
    Node row = content.hierarchy->node(node); // waits for it
    if (content.hierarchy->peek(node, row) == RowState::Lost)
    {
      step.error = makeError(Error::Kind::Corrupt,
        "'" + content.description.path + "' is damaged: the row of node " + std::to_string(node) +
          " in the node table cannot be read; copy the file again or build the store again");
      continue;
    }
    step.fetched = FetchedNode{ node, wanted[i].columns, {}, 0, row };
    step.fetched.runs.push_back(content.directory->prepare(node, row.pointCount, records.of(step)));
    step.fetched.bytesRead = step.fetched.runs.back().size;
  }
  records.run();
  NodeReads here(*content.file, stop);
  NodeReads elsewhere(content.fileElsewhere ? *content.fileElsewhere : *content.file, stop);
  for (Step& step : steps)
  {
    if (step.error)
    {
      continue;
    }
    FetchedNode& fetched = step.fetched;
    const Result<NodePayload> payload =
      content.directory->decode(fetched.node, fetched.runs.front());
    if (!payload)
    {
      step.error = payload.error();
      continue;
    }
    for (const BlockRuns::Run& run : BlockRuns(*payload, fetched.columns).runs)
    {
      fetched.runs.emplace_back(run.bytes);
      std::vector<ByteRange>& reads = (run.elsewhere ? elsewhere : here).of(step);
      reads.push_back({ run.offset, run.bytes, fetched.runs.back().data.get() });
      fetched.bytesRead += run.bytes;
    }
  }
  here.run();
  elsewhere.run();
  std::vector<Result<FetchedNode>> results;
  results.reserve(steps.size());
  for (Step& step : steps)
  {
    results.push_back(resultOf(std::move(step)));
  }
  return results;
}

} // namespace pointfront
