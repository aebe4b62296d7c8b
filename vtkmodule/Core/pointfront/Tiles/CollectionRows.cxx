#include "pointfront/Tiles/CollectionRows.h"

#include <algorithm>
#include <utility>

namespace pointfront
{
namespace
{
/// Bytes that an opening reads, for those who share a disk fairly.
constexpr std::size_t openingBytes = std::size_t(320) << 10;
} // namespace

CollectionRows::CollectionRows(std::shared_ptr<const CollectionTiles> tiles)
  : tiles_(std::move(tiles))
  , told_(tiles_->record().tiles.size())
  , ended_(tiles_->record().tiles.size())
{
}

RowState CollectionRows::ask(std::size_t tile)
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (told_[tile])
    {
      return RowState::Coming; // or it has just come: who asks again finds it open
    }
    told_[tile] = true;
    wanted_.push_back(tile);
    if (!tilesWanted_.exchange(true))
    {
      for (const auto& [reader, wanted] : readers_)
      {
        wanted();
      }
    }
  }
  return RowState::Coming;
}

RowState CollectionRows::asked(RowState state)
{
  if (state == RowState::Coming)
  {
    pagesWanted_ = true;
  }
  return state;
}

std::function<void()> CollectionRows::teller(const std::function<void()>& wanted)
{
  return [this, wanted]
  {
    pagesWanted_ = true;
    wanted();
  };
}

Result<const CollectionTiles::Tile*> CollectionRows::open(std::size_t tile)
{
  if (const CollectionTiles::Tile* const open = tiles_->opened(tile))
  {
    return open;
  }
  Result<const CollectionTiles::Tile*> opened = tiles_->open(tile); // may wait
  const std::lock_guard<std::mutex> lock(mutex_);
  if (!opened && opened.error().kind == Error::Kind::Cancelled)
  {
    told_[tile] = false; // it may be asked for again
  }
  else if (!ended_[tile])
  {
    told_[tile] = true;
    ended_[tile] = true;
    if (opened)
    {
      tables_.push_back((*opened)->cloud->hierarchy());
      if (MissingRows* const rows = tables_.back()->missingRows())
      {
        for (const auto& [reader, wanted] : readers_)
        {
          rows->attach(reader, teller(wanted));
        }
      }
    }
    else
    {
      firstFault_ = firstFault_ ? firstFault_ : opened.error();
    }
  }
  ++opened_;
  changed_.notify_all();
  return opened;
}

std::vector<CollectionRows::Table> CollectionRows::openTables() const
{
  const std::lock_guard<std::mutex> lock(mutex_);
  return tables_;
}

bool CollectionRows::waiting() const
{
  if (tilesWanted_)
  {
    return true;
  }
  // Taken back before it is looked whether it is so: who asks meanwhile sets it again.
  if (pagesWanted_.exchange(false))
  {
    const std::vector<Table> tables = openTables();
    if (std::any_of(tables.begin(), tables.end(),
          [](const Table& table)
          { return table->missingRows() != nullptr && table->missingRows()->waiting(); }))
    {
      pagesWanted_ = true;
    }
  }
  return pagesWanted_;
}

std::optional<std::size_t> CollectionRows::nextWanted()
{
  const std::lock_guard<std::mutex> lock(mutex_);
  if (wanted_.empty())
  {
    return std::nullopt;
  }
  const std::size_t tile = wanted_.front();
  wanted_.erase(wanted_.begin());
  tilesWanted_ = !wanted_.empty();
  ++opening_;
  return tile;
}

std::size_t CollectionRows::readNext()
{
  if (const std::optional<std::size_t> tile = nextWanted())
  {
    const Result<const CollectionTiles::Tile*> opened = open(*tile);
    static_cast<void>(opened); // a fault is kept
    const std::lock_guard<std::mutex> lock(mutex_);
    --opening_;
    changed_.notify_all();
    return openingBytes;
  }
  for (const Table& table : openTables())
  {
    MissingRows* const rows = table->missingRows();
    if (rows != nullptr && rows->waiting())
    {
      if (const std::size_t bytes = rows->readNext(); bytes > 0)
      {
        return bytes;
      }
    }
  }
  return 0;
}

void CollectionRows::attach(const void* reader, std::function<void()> wanted)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const Table& table : tables_)
  {
    if (MissingRows* const rows = table->missingRows())
    {
      rows->attach(reader, teller(wanted));
    }
  }
  readers_[reader] = std::move(wanted);
}

void CollectionRows::detach(const void* reader)
{
  const std::lock_guard<std::mutex> lock(mutex_);
  readers_.erase(reader);
  for (const Table& table : tables_)
  {
    if (MissingRows* const rows = table->missingRows())
    {
      rows->detach(reader);
    }
  }
  changed_.notify_all();
}

std::uint64_t CollectionRows::arrivals() const
{
  std::uint64_t sum = opened_;
  const std::lock_guard<std::mutex> lock(mutex_);
  for (const Table& table : tables_)
  {
    sum += table->arrivals();
  }
  return sum;
}

bool CollectionRows::wait(std::uint64_t seen, std::chrono::steady_clock::time_point end)
{
  std::unique_lock<std::mutex> lock(mutex_);
  if (wanted_.empty() && opening_ == 0)
  {
    // Nothing is being opened: only open tables may have something.
    const std::vector<Table> tables = tables_;
    lock.unlock();
    bool coming = false;
    for (const Table& table : tables)
    {
      if (arrivals() != seen)
      {
        return true;
      }
      coming = table->waitForArrival(table->arrivals(), end) || coming;
    }
    return coming || arrivals() != seen;
  }
  if (readers_.empty() && !wanted_.empty())
  {
    lock.unlock();
    readNext();
    return true;
  }
  const std::uint64_t before = opened_;
  changed_.wait_until(lock, end, [&] { return opened_ != before || readers_.empty(); });
  return true;
}

std::optional<Error> CollectionRows::fault() const
{
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (firstFault_)
    {
      return firstFault_;
    }
  }
  for (const Table& table : openTables())
  {
    if (std::optional<Error> fault = table->fault())
    {
      return fault;
    }
  }
  return std::nullopt;
}

std::vector<Error> CollectionRows::takeFaults() const
{
  std::vector<Error> all;
  for (const Table& table : openTables())
  {
    const std::vector<Error> faults = table->takeFaults();
    all.insert(all.end(), faults.begin(), faults.end());
  }
  return all;
}

} // namespace pointfront
