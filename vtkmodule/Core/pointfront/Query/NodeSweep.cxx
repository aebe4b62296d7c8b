#include "pointfront/Query/NodeSweep.h"

#include "pointfront/Base/ExportClock.h"
#include "pointfront/Threads/ThreadCrew.h"
#include "pointfront/Threads/WorkBeside.h"

#include <algorithm>
#include <future>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pointfront
{
namespace
{

/// Points for each thread between two moments at which all threads wait for the last one, and at
/// which the work can be cancelled: some ms.
constexpr std::size_t pointsOfThread = 200000;
/// Choosing: a flag, a number and a position for each point; numbers of points in an index.
constexpr std::size_t bytesToChoose = 64;

struct Chosen
{
  std::uint64_t bytesRead = 0;
  std::uint64_t pointsRead = 0;
  QueryBatch batch;
};

/// Neighbours in the list that are read together.
struct Wave
{
  std::size_t first = 0;
  std::size_t count = 0;
  std::size_t bytes = 0; ///< set aside for it while it is read
};

/// Memory that one thread takes while it reads a node and chooses, without the result.
std::size_t workBytes(const NodeReader& reader, const NodeSweep& nodes, std::size_t task)
{
  const NodeIndex node = nodes.node(task);
  const std::uint32_t points = nodes.points(task);
  return 2 * reader.storedBytes(node, nodes.columns) +
    reader.decodedBytes(node, points, nodes.columns) + points * bytesToChoose;
}

std::size_t resultBytes(const NodeSweep& nodes, std::size_t task)
{
  return nodes.points(task) * nodes.resultBytes + sizeof(Result<Chosen>);
}

class Sweep
{
public:
  Sweep(const NodeReader& reader, const NodeSweep& nodes, const QueryOptions& options)
    : reader_(reader)
    , nodes_(nodes)
    , memoryBytes_(options.memoryBytes)
    , crew_(options.crew != nullptr ? *options.crew : ThreadCrew::ofProcess())
    , clock_(options.progress, totalPoints(), options.phase)
  {
  }

  Result<QueryReport> run(const QueryConsumer& consume);

private:
  using Results = std::vector<Result<Chosen>>;

  std::uint64_t totalPoints() const
  {
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < nodes_.count; ++i)
    {
      sum += nodes_.points(i);
    }
    return sum;
  }
  /// As many nodes from `first` on as `memory` allows; none if that is not even one.
  Wave nextWave(std::size_t first, std::size_t memory) const;
  Results read(const Wave& wave) const;
  Result<Chosen> readOne(std::size_t task) const;
  std::future<Results> begin(const Wave& wave) const
  {
    return workBeside([this, wave] { return read(wave); });
  }
  Result<void> handOver(Results& results, const QueryConsumer& consume);

  const NodeReader& reader_;
  const NodeSweep& nodes_;
  std::size_t memoryBytes_;
  ThreadCrew& crew_;
  ExportClock clock_;
  QueryReport report_;
};

Wave Sweep::nextWave(std::size_t first, std::size_t memory) const
{
  const std::size_t threads = crew_.threads();
  Wave wave{ first, 0, 0 };
  std::size_t points = 0;
  std::size_t results = 0;
  std::size_t largest = 0; // the most that one thread takes
  for (std::size_t i = first; i < nodes_.count && points < threads * pointsOfThread; ++i)
  {
    points += nodes_.points(i);
    results += resultBytes(nodes_, i);
    largest = std::max(largest, workBytes(reader_, nodes_, i));
    const std::size_t needed = results + std::min(threads, wave.count + 1) * largest;
    if (needed > memory)
    {
      break;
    }
    ++wave.count;
    wave.bytes = needed;
  }
  return wave;
}

Result<Chosen> Sweep::readOne(std::size_t task) const
{
  Chosen chosen;
  Result<NodeColumns> columns = makeError(Error::Kind::Cancelled, "not read");
  {
    const Result<FetchedNode> fetched = reader_.fetch(nodes_.node(task), nodes_.columns);
    if (!fetched)
    {
      return fetched.error();
    }
    chosen.bytesRead = fetched->bytesRead;
    columns = reader_.decode(*fetched);
  }
  if (!columns)
  {
    return columns.error();
  }
  chosen.pointsRead = columns->size();
  chosen.batch = nodes_.choose(task, std::move(*columns));
  return chosen;
}

Sweep::Results Sweep::read(const Wave& wave) const
{
  Results results(wave.count, makeError(Error::Kind::Cancelled, "not read"));
  crew_.run(
    wave.count, [&](std::size_t piece, unsigned) { results[piece] = readOne(wave.first + piece); });
  return results;
}

Result<void> Sweep::handOver(Results& results, const QueryConsumer& consume)
{
  for (Result<Chosen>& result : results)
  {
    if (!result)
    {
      return result.error();
    }
    Chosen chosen = std::move(*result);
    ++report_.nodesRead;
    report_.bytesRead += chosen.bytesRead;
    report_.pointsRead += chosen.pointsRead;
    report_.pointsChosen += chosen.batch.size();
    if (chosen.batch.size() > 0)
    {
      if (Result<void> consumed = consume(chosen.batch); !consumed)
      {
        return consumed.error();
      }
    }
    if (!clock_.report(report_.pointsRead))
    {
      return makeError(Error::Kind::Cancelled, "reading of points was cancelled");
    }
  }
  return {};
}

std::size_t bytesOf(const std::vector<Result<Chosen>>& results)
{
  std::size_t sum = results.size() * sizeof(Result<Chosen>);
  for (const Result<Chosen>& result : results)
  {
    sum += result ? result->batch.bytes() : 0;
  }
  return sum;
}

Result<QueryReport> Sweep::run(const QueryConsumer& consume)
{
  std::optional<std::future<Results>> ahead;
  std::size_t next = 0;
  while (next < nodes_.count || ahead)
  {
    Results results;
    if (ahead)
    {
      results = ahead->get();
      ahead.reset();
    }
    else
    {
      const Wave wave = nextWave(next, memoryBytes_);
      if (wave.count == 0)
      {
        return makeError(Error::Kind::NoMemory,
          "node " + std::to_string(nodes_.node(next)) + " alone, with its " +
            std::to_string(nodes_.points(next)) + " points, needs more than the " +
            std::to_string(memoryBytes_) + " bytes of memory that a query may use");
      }
      report_.peakBytes = std::max(report_.peakBytes, wave.bytes);
      next += wave.count;
      results = read(wave);
    }
    const std::size_t held = bytesOf(results);
    if (next < nodes_.count && held < memoryBytes_)
    {
      const Wave wave = nextWave(next, memoryBytes_ - held);
      if (wave.count > 0)
      {
        report_.peakBytes = std::max(report_.peakBytes, held + wave.bytes);
        next += wave.count;
        ahead = begin(wave);
      }
    }
    if (Result<void> handed = handOver(results, consume); !handed)
    {
      return handed.error();
    }
  }
  return report_;
}

} // namespace

std::size_t QueryBatch::bytes() const
{
  std::size_t sum =
    ids.capacity() * sizeof(std::uint64_t) + points.positions.capacity() * sizeof(glm::dvec3);
  for (const std::vector<std::byte>& column : points.columns)
  {
    sum += column.capacity() + sizeof(column);
  }
  return sum;
}

Result<QueryReport> sweepNodes(const NodeReader& reader, const NodeSweep& sweep,
  const QueryOptions& options, const QueryConsumer& consume)
{
  try
  {
    return Sweep(reader, sweep, options).run(consume);
  }
  catch (const std::bad_alloc&)
  {
    return makeError(Error::Kind::NoMemory,
      "the system gave no more memory to the query; ask for fewer points or attributes");
  }
}

std::size_t leastSweepBytes(const NodeReader& reader, const NodeSweep& sweep)
{
  std::size_t most = 0;
  for (std::size_t i = 0; i < sweep.count; ++i)
  {
    most = std::max(most, workBytes(reader, sweep, i) + resultBytes(sweep, i));
  }
  return most;
}

} // namespace pointfront
