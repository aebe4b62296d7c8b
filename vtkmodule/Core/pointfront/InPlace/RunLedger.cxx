#include "pointfront/InPlace/RunLedger.h"

#include "pointfront/InPlace/SampleStream.h"

#include <algorithm>

namespace pointfront
{
namespace
{
constexpr std::uint64_t pageBytes = 4096;
/// A number takes some two bytes in a list: what a batch may add, for the memory account.
constexpr std::uint64_t bytesPerRun = 3;
/// Lists may take this part of the memory: arrays grow by doubling, and a spill copies them once.
constexpr std::uint64_t memoryShare = 3;

/// True if the stream of a coarser holder than the one at `below` has the point.
bool heldAbove(const std::vector<QuadTree::Holder>& holders, std::size_t below, std::uint64_t point)
{
  for (std::size_t h = 0; h < below; ++h)
  {
    if (SampleStream{ holders[h].logStep }.contains(point))
    {
      return true;
    }
  }
  return false;
}

void findSamples(
  const LeafRun& run, const std::vector<QuadTree::Holder>& holders, std::vector<HeldSample>& found)
{
  for (std::size_t h = 0; h < holders.size(); ++h)
  {
    const SampleStream stream{ holders[h].logStep };
    const std::uint64_t last = (run.first + run.count - 1) >> stream.logStep;
    for (std::uint64_t stratum = run.first >> stream.logStep; stratum <= last; ++stratum)
    {
      const std::uint64_t point = stream.sample(stratum);
      if (point >= run.first && point < run.first + run.count && !heldAbove(holders, h, point))
      {
        found.push_back({ holders[h].node, stratum, point });
      }
    }
  }
}
} // namespace

SampleFinder::SampleFinder(const QuadTree& tree)
  : holders_(tree.nodes().size())
{
  for (NodeIndex i = 0; i < tree.nodes().size(); ++i)
  {
    const QuadNode& node = tree.nodes()[i];
    if (node.leaf() || node.sliced)
    {
      holders_[i] = tree.holdersAbove(node.sliced ? node.firstChild : i);
    }
  }
}

void SampleFinder::find(RunBatch& batch) const
{
  batch.samples.clear();
  batch.sampleEnd.clear();
  for (const LeafRun& run : batch.runs)
  {
    const std::size_t begin = batch.samples.size();
    findSamples(run, holders_[run.leaf], batch.samples);
    if (batch.samples.size() > begin + 1)
    {
      std::sort(batch.samples.begin() + static_cast<std::ptrdiff_t>(begin), batch.samples.end(),
        [](const HeldSample& a, const HeldSample& b) { return a.point < b.point; });
    }
    batch.sampleEnd.push_back(batch.samples.size());
  }
}

RunLedger::RunLedger(const QuadTree& tree, const GridRecords& records, std::uint64_t memoryBytes,
  std::string temporaryFolder)
  : tree_(tree)
  , records_(records)
  , memoryBytes_(memoryBytes)
  , folder_(std::move(temporaryFolder))
  , entries_(tree.nodes().size())
  , slicedSoFar_(tree.nodes().size())
{
}

void RunLedger::touch(Entry& entry, std::uint64_t first, std::uint64_t count)
{
  std::uint64_t from = (records_.fileOffset + first * records_.stride) / pageBytes;
  const std::uint64_t to =
    (records_.fileOffset + (first + count) * records_.stride - 1) / pageBytes;
  from = entry.lastPage == UINT64_MAX ? from : std::max(from, entry.lastPage + 1);
  entry.pages += to + 1 > from ? to + 1 - from : 0;
  entry.lastPage = to;
}

void RunLedger::enterRun(NodeIndex leaf, const Run& run, const RecordBox& box)
{
  Entry& entry = entries_[leaf];
  entry.list.add(run);
  entry.points += run.count;
  entry.box.add(box);
  touch(entry, run.first, run.count);
}

void RunLedger::enterSlices(const LeafRun& run, const HeldSample* samples, std::size_t sampleCount)
{
  const QuadNode& group = tree_.nodes()[run.leaf];
  std::uint64_t& before = slicedSoFar_[run.leaf];
  const auto sliceOf = [&](std::uint64_t ordinal)
  {
    return group.firstChild +
      static_cast<NodeIndex>(
        std::min<std::uint64_t>(ordinal / group.sliceStep, group.childCount - 1u));
  };
  for (std::size_t s = 0; s < sampleCount; ++s)
  {
    --entries_[sliceOf(before + samples[s].point - run.first)].points; // modulo 2^64 for a moment
  }
  for (std::uint64_t done = 0; done < run.count;)
  {
    const NodeIndex slice = sliceOf(before);
    const std::uint64_t room = slice + 1 == group.firstChild + group.childCount
      ? UINT64_MAX
      : (slice - group.firstChild + 1) * group.sliceStep - before;
    const Run part{ run.first + done, std::min(room, run.count - done) };
    enterRun(slice, part, boxOf(records_, part.first, part.first + part.count));
    done += part.count;
    before += part.count;
  }
}

void RunLedger::enter(const LeafRun& run, const HeldSample* samples, std::size_t sampleCount)
{
  if (tree_.nodes()[run.leaf].sliced)
  {
    enterSlices(run, samples, sampleCount);
  }
  else
  {
    enterRun(run.leaf, Run{ run.first, run.count }, run.box);
    entries_[run.leaf].points -= sampleCount;
  }
  for (std::size_t s = 0; s < sampleCount; ++s)
  {
    Entry& entry = entries_[samples[s].holder];
    entry.list.add(Run{ samples[s].stratum, 1 });
    ++entry.points;
    touch(entry, samples[s].point, 1);
  }
}

Result<void> RunLedger::add(const RunBatch& batch)
{
  std::size_t begin = 0;
  for (std::size_t i = 0; i < batch.runs.size(); ++i)
  {
    enter(batch.runs[i], batch.samples.data() + begin, batch.sampleEnd[i] - begin);
    begin = batch.sampleEnd[i];
  }
  held_ += bytesPerRun * (batch.runs.size() + batch.samples.size());
  return held_ > memoryBytes_ / memoryShare ? spill() : Result<void>();
}

Result<void> RunLedger::spill()
{
  std::vector<std::byte> all;
  Spill next;
  for (Entry& entry : entries_)
  {
    const std::vector<std::byte> bytes = entry.list.take();
    all.insert(all.end(), bytes.begin(), bytes.end());
    next.ends.push_back(all.size());
  }
  held_ = 0;
  Result<std::unique_ptr<SpillFile>> file = SpillFile::create(folder_, all.size());
  if (!file)
  {
    return file.error();
  }
  next.file = std::move(*file);
  spilledBytes_ += all.size();
  if (Result<void> written = next.file->write(0, all.data(), all.size()); !written)
  {
    return written;
  }
  spills_.push_back(std::move(next));
  return {};
}

Result<void> RunLedger::write(const ListSink& to)
{
  std::vector<std::byte> list;
  for (NodeIndex i = 0; i < entries_.size(); ++i)
  {
    list.clear();
    for (const Spill& spill : spills_)
    {
      const std::uint64_t begin = i == 0 ? 0 : spill.ends[i - 1];
      const auto bytes = static_cast<std::size_t>(spill.ends[i] - begin);
      list.resize(list.size() + bytes);
      if (Result<void> read = spill.file->read(begin, list.data() + list.size() - bytes, bytes);
          !read)
      {
        return read;
      }
    }
    entries_[i].list.finish();
    const std::vector<std::byte> last = entries_[i].list.take();
    list.insert(list.end(), last.begin(), last.end());
    if (Result<void> done = to(i, list); !done)
    {
      return done;
    }
  }
  return {};
}

} // namespace pointfront
