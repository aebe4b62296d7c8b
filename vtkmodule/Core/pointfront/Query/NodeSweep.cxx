#include "pointfront/Query/NodeSweep.h"

#include "pointfront/Base/ExportClock.h"
#include "pointfront/Query/GroupedFetch.h"
#include "pointfront/Threads/ThreadCrew.h"
#include "pointfront/Threads/WorkBeside.h"

#include <algorithm>
#include <chrono>
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
/// Groups of nodes from afar that make a wave, as multiples of what is under way at a time: the
/// line is idle for a round trip between two waves.
constexpr std::size_t groupsOfWave = 3;

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

/// Bytes of a node in the source. Some far sources know them only when they come.
std::size_t storedBytes(const NodeReader& reader, const NodeSweep& nodes, std::size_t task)
{
  const NodeIndex node = nodes.node(task);
  const std::size_t known = reader.storedBytes(node, nodes.columns);
  return known > 0 || !reader.readCost().far()
    ? known
    : reader.decodedBytes(node, nodes.points(task), nodes.columns);
}

/// Memory that one thread takes while it reads a node and chooses, without the result.
std::size_t workBytes(
  const NodeReader& reader, const NodeSweep& nodes, std::size_t task, std::size_t stored)
{
  const NodeIndex node = nodes.node(task);
  const std::uint32_t points = nodes.points(task);
  return 2 * stored + reader.decodedBytes(node, points, nodes.columns) + points * bytesToChoose;
}

std::size_t resultBytes(const NodeSweep& nodes, std::size_t task)
{
  return nodes.points(task) * nodes.resultBytes + sizeof(Result<Chosen>);
}

Error cancelled()
{
  return makeError(Error::Kind::Cancelled, "reading of points was cancelled");
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
    , far_(reader.readCost().far())
  {
  }

  Result<QueryReport> run(const QueryConsumer& consume);

private:
  using Results = std::vector<Result<Chosen>>;

  Result<QueryReport> run(const QueryConsumer& consume, std::optional<std::future<Results>>& ahead);

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
  Results read(const Wave& wave);
  Results readFar(const Wave& wave);
  Result<Chosen> readOne(std::size_t task) const;
  Result<Chosen> chosenOf(std::size_t task, Result<FetchedNode> fetched) const;
  std::future<Results> begin(const Wave& wave)
  {
    return workBeside([this, wave] { return read(wave); });
  }
  Result<Results> waitFor(std::future<Results>& wave);
  Result<void> handOver(Results& results, const QueryConsumer& consume);

  const NodeReader& reader_;
  const NodeSweep& nodes_;
  std::size_t memoryBytes_;
  ThreadCrew& crew_;
  ExportClock clock_;
  const bool far_;
  ReadStop stop_{ false }; ///< nobody wants what is under way
  QueryReport report_;
};

Wave Sweep::nextWave(std::size_t first, std::size_t memory) const
{
  const std::size_t threads = crew_.threads();
  const ReadCost cost = reader_.readCost();
  const std::size_t farBytes = far_
    ? groupsOfWave * std::max(1u, cost.readsAtOnce) * std::max<std::size_t>(cost.bytesAtOnce, 1)
    : 0;
  Wave wave{ first, 0, 0 };
  std::size_t points = 0;
  std::size_t results = 0;
  std::size_t fetched = 0;
  std::size_t largest = 0; // the most that one thread takes
  for (std::size_t i = first;
       i < nodes_.count && (points < threads * pointsOfThread || fetched < farBytes); ++i)
  {
    const std::size_t stored = storedBytes(reader_, nodes_, i);
    points += nodes_.points(i);
    results += resultBytes(nodes_, i);
    fetched += far_ ? stored : 0; // all of the wave may lie there before the first is decoded
    largest = std::max(largest, workBytes(reader_, nodes_, i, stored));
    const std::size_t beside = fetched > stored ? fetched : 0; // one alone is part of the work
    const std::size_t needed = results + beside + std::min(threads, wave.count + 1) * largest;
    if (needed > memory)
    {
      break;
    }
    ++wave.count;
    wave.bytes = needed;
  }
  return wave;
}

Result<Chosen> Sweep::chosenOf(std::size_t task, Result<FetchedNode> fetched) const
{
  if (!fetched)
  {
    return fetched.error();
  }
  Chosen chosen;
  chosen.bytesRead = fetched->bytesRead;
  Result<NodeColumns> columns = reader_.decode(*fetched);
  fetched = makeError(Error::Kind::Cancelled, "decoded"); // its bytes go before the choice
  if (!columns)
  {
    return columns.error();
  }
  chosen.pointsRead = columns->size();
  chosen.batch = nodes_.choose(task, std::move(*columns));
  return chosen;
}

Result<Chosen> Sweep::readOne(std::size_t task) const
{
  return chosenOf(task, reader_.fetch(nodes_.node(task), nodes_.columns));
}

Sweep::Results Sweep::read(const Wave& wave)
{
  if (far_)
  {
    return readFar(wave);
  }
  Results results(wave.count, makeError(Error::Kind::Cancelled, "not read"));
  crew_.run(
    wave.count, [&](std::size_t piece, unsigned) { results[piece] = readOne(wave.first + piece); });
  return results;
}

/// The crew decodes what has come while the rest is on its way; no thread of it waits for the line.
Sweep::Results Sweep::readFar(const Wave& wave)
{
  std::vector<WantedNode> wanted;
  std::vector<std::size_t> bytes;
  for (std::size_t i = wave.first; i < wave.first + wave.count; ++i)
  {
    wanted.push_back({ nodes_.node(i), nodes_.columns });
    bytes.push_back(storedBytes(reader_, nodes_, i));
  }
  GroupedFetch fetch(reader_, std::move(wanted), bytes, stop_);
  Results results(wave.count, makeError(Error::Kind::Cancelled, "not read"));
  std::size_t done = 0;
  bool right = true;
  for (auto nodes = fetch.next(); !nodes.empty(); nodes = fetch.next())
  {
    crew_.run(nodes.size(),
      [&](std::size_t piece, unsigned)
      { results[done + piece] = chosenOf(wave.first + done + piece, std::move(nodes[piece])); });
    for (const std::size_t end = done + nodes.size(); done < end; ++done)
    {
      right = right && results[done];
    }
    if (!right)
    {
      break; // the first error is known: nobody waits for what comes after it
    }
  }
  return results;
}

/// While the line is slow, a wish to stop is heard nevertheless.
Result<Sweep::Results> Sweep::waitFor(std::future<Results>& wave)
{
  constexpr std::chrono::milliseconds lookAgain{ 50 };
  while (far_ && wave.wait_for(lookAgain) == std::future_status::timeout)
  {
    if (!clock_.report(report_.pointsRead))
    {
      return cancelled();
    }
  }
  return wave.get();
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
      return cancelled();
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
  Result<QueryReport> report = makeError(Error::Kind::Cancelled, "");
  try
  {
    report = run(consume, ahead);
  }
  catch (...)
  {
    stop_ = true; // or the future would wait for bytes that nobody wants
    throw;
  }
  stop_ = stop_ || !report;
  return report;
}

Result<QueryReport> Sweep::run(
  const QueryConsumer& consume, std::optional<std::future<Results>>& ahead)
{
  std::size_t next = 0;
  while (next < nodes_.count || ahead)
  {
    Results results;
    if (!ahead)
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
      if (far_)
      {
        ahead = begin(wave);
      }
      else
      {
        results = read(wave);
      }
    }
    if (ahead)
    {
      Result<Results> come = waitFor(*ahead);
      if (!come)
      {
        return come.error();
      }
      ahead.reset();
      results = std::move(*come);
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
    most = std::max(
      most, workBytes(reader, sweep, i, storedBytes(reader, sweep, i)) + resultBytes(sweep, i));
  }
  return most;
}

} // namespace pointfront
