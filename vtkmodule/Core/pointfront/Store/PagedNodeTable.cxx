#include "pointfront/Store/PagedNodeTable.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cassert>
#include <condition_variable>
#include <map>
#include <mutex>
#include <new>
#include <unordered_set>
#include <utility>

namespace pointfront
{
namespace
{
constexpr std::size_t waysPerSet = 12;
constexpr std::uint32_t noPage = 0xffffffffu;
constexpr std::size_t mostWanted = 1024;

/// Pages whose numbers leave the same rest: one lock, and no map that would allocate.
class PageSet
{
public:
  PageSet() { pages_.fill(noPage); }
  bool copyRow(std::uint32_t page, std::uint32_t row, Node& target)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (std::size_t w = 0; w < waysPerSet; ++w)
    {
      if (pages_[w] == page)
      {
        used_[w] = ++clock_;
        target = (*rows_[w])[row];
        return true;
      }
    }
    return false;
  }

  /// True when that took memory.
  bool insert(std::uint32_t page, const NodePage& rows)
  {
    const std::lock_guard<std::mutex> lock(mutex_);
    std::size_t way = 0;
    for (std::size_t w = 0; w < waysPerSet; ++w)
    {
      if (pages_[w] == page)
      {
        return false; // another thread was faster
      }
      way = used_[w] < used_[way] ? w : way;
    }
    const bool fresh = !rows_[way];
    if (fresh)
    {
      rows_[way] = std::make_unique<NodePage>();
    }
    *rows_[way] = rows;
    pages_[way] = page;
    used_[way] = ++clock_;
    return fresh;
  }

private:
  std::mutex mutex_;
  std::array<std::uint32_t, waysPerSet> pages_{};
  std::array<std::uint64_t, waysPerSet> used_{};
  std::array<std::unique_ptr<NodePage>, waysPerSet> rows_;
  std::uint64_t clock_ = 0;
};

/// Stands in for a row that is lost.
const Node hollowRow{};
} // namespace

struct PagedNodeTable::Content final : MissingRows
{
  Content(std::unique_ptr<const NodePageSource> from, std::vector<NodeIndex> rootNodes,
    Refinement kind, std::size_t cacheBytes)
    : source(std::move(from))
    , nodes(source->nodeCount())
    , pageRows(source->pageRows())
    , roots(std::move(rootNodes))
    , refinement(kind)
    , sets(std::max<std::size_t>(1,
        std::min<std::size_t>(cacheBytes / (waysPerSet * sizeof(NodePage)),
          nodePageCount(nodes, pageRows) / waysPerSet + 1)))
  {
    wanted.reserve(mostWanted);
  }

  PageSet& setOf(std::uint32_t page) { return sets[page % sets.size()]; }
  bool isLost(std::uint32_t page);
  bool load(std::uint32_t page, NodePage& rows);
  bool keep(std::uint32_t page, const NodePage& rows, const Result<void>& done);
  void noteFault(Error error);
  bool linked(NodeIndex parent, const Node& parentRow, NodeIndex child, const Node& row);
  const Node* rootRow(NodeIndex index) const;
  void want(std::uint32_t page);

  bool waiting() const override { return anyWanted; }
  std::size_t readNext() override;
  void attach(const void* reader, std::function<void()> tell) override;
  void detach(const void* reader) override;

  const std::unique_ptr<const NodePageSource> source;
  const NodeIndex nodes;
  const std::uint32_t pageRows;
  const std::vector<NodeIndex> roots; ///< ascending
  std::vector<Node> rootRows; ///< theirs, or none
  const Refinement refinement;
  std::vector<PageSet> sets;
  std::atomic<std::uint64_t> pagesRead{ 0 };
  std::atomic<std::size_t> pagesHeld{ 0 };
  std::atomic<std::uint64_t> arrivals{ 0 };

  std::mutex faultMutex; ///< guards what follows
  std::unordered_set<std::uint32_t> lost; ///< pages
  std::unordered_set<NodeIndex> unlinked; ///< nodes that deny their parent
  std::optional<Error> firstFault;
  std::vector<Error> newFaults;
  std::atomic<bool> damaged{ false }; ///< written under the lock

  std::mutex wantedMutex; ///< guards what follows
  std::condition_variable changed;
  std::vector<std::uint32_t> wanted; ///< the oldest first
  std::vector<std::uint32_t> beingRead;
  std::map<const void*, std::function<void()>> readers;
  std::atomic<bool> anyWanted{ false }; ///< !wanted.empty(); written under the lock
};

bool PagedNodeTable::Content::isLost(std::uint32_t page)
{
  if (!damaged)
  {
    return false;
  }
  const std::lock_guard<std::mutex> lock(faultMutex);
  return lost.count(page) > 0;
}

/// Under the lock of the faults.
void PagedNodeTable::Content::noteFault(Error error)
{
  firstFault = firstFault ? firstFault : error;
  newFaults.push_back(std::move(error));
  damaged = true;
}

/// Keeps a page that was read; false when it is lost.
bool PagedNodeTable::Content::keep(
  std::uint32_t page, const NodePage& rows, const Result<void>& done)
{
  if (done)
  {
    pagesHeld += setOf(page).insert(page, rows) ? 1 : 0;
    return true;
  }
  const std::lock_guard<std::mutex> lock(faultMutex);
  if (lost.insert(page).second)
  {
    noteFault(done.error());
  }
  return false;
}

/// Reads a page and keeps it; false when it is lost.
bool PagedNodeTable::Content::load(std::uint32_t page, NodePage& rows)
{
  try
  {
    const Result<void> done = source->read(page, rows);
    ++pagesRead;
    return keep(page, rows, done);
  }
  catch (const std::bad_alloc&)
  {
    return keep(
      page, rows, makeError(Error::Kind::NoMemory, "no memory for a page of the node table"));
  }
}

bool PagedNodeTable::Content::linked(
  NodeIndex parent, const Node& parentRow, NodeIndex child, const Node& row)
{
  if (row.parent == parent && row.level == parentRow.level + 1)
  {
    return true;
  }
  const std::lock_guard<std::mutex> lock(faultMutex);
  if (unlinked.insert(child).second)
  {
    noteFault(makeError(Error::Kind::Corrupt,
      "node " + std::to_string(child) + " of the node table denies node " + std::to_string(parent) +
        ", which names it as a child; build the store again"));
  }
  return false;
}

const Node* PagedNodeTable::Content::rootRow(NodeIndex index) const
{
  if (rootRows.empty() || index > roots.back())
  {
    return nullptr;
  }
  const auto root = std::lower_bound(roots.begin(), roots.end(), index);
  return *root == index ? &rootRows[static_cast<std::size_t>(root - roots.begin())] : nullptr;
}

void PagedNodeTable::Content::want(std::uint32_t page)
{
  const auto among = [page](const std::vector<std::uint32_t>& pages)
  { return std::find(pages.begin(), pages.end(), page) != pages.end(); };
  const std::lock_guard<std::mutex> lock(wantedMutex);
  if (wanted.size() == mostWanted || among(wanted) || among(beingRead))
  {
    return;
  }
  wanted.push_back(page);
  if (!anyWanted.exchange(true))
  {
    for (const auto& [reader, tell] : readers)
    {
      tell();
    }
  }
}

std::size_t PagedNodeTable::Content::readNext()
{
  std::vector<std::uint32_t> pages;
  {
    const std::lock_guard<std::mutex> lock(wantedMutex);
    if (wanted.empty())
    {
      return 0;
    }
    const auto end =
      wanted.begin() + static_cast<std::ptrdiff_t>(std::min(wanted.size(), source->pagesAtOnce()));
    pages.assign(wanted.begin(), end);
    beingRead.insert(beingRead.end(), pages.begin(), pages.end());
    wanted.erase(wanted.begin(), end);
    anyWanted = !wanted.empty();
  }
  const auto end = [&]
  {
    const std::lock_guard<std::mutex> lock(wantedMutex);
    for (const std::uint32_t page : pages)
    {
      beingRead.erase(std::find(beingRead.begin(), beingRead.end(), page));
    }
    ++arrivals;
    changed.notify_all();
  };
  try
  {
    std::vector<NodePage> rows(pages.size());
    const std::vector<Result<void>> done = source->readAll(pages, rows);
    pagesRead += pages.size();
    for (std::size_t p = 0; p < pages.size(); ++p)
    {
      keep(pages[p], rows[p], done[p]);
    }
  }
  catch (...)
  {
    end(); // the pages can be asked for again
    throw;
  }
  end();
  return pages.size() * nodePageBytes;
}

void PagedNodeTable::Content::attach(const void* reader, std::function<void()> tell)
{
  const std::lock_guard<std::mutex> lock(wantedMutex);
  readers[reader] = std::move(tell);
}

void PagedNodeTable::Content::detach(const void* reader)
{
  const std::lock_guard<std::mutex> lock(wantedMutex);
  readers.erase(reader);
  changed.notify_all();
}

PagedNodeTable::PagedNodeTable(std::unique_ptr<const NodePageSource> source,
  std::vector<NodeIndex> roots, Refinement refinement, std::size_t cacheBytes)
  : content_(std::make_unique<Content>(std::move(source), std::move(roots), refinement, cacheBytes))
{
}

PagedNodeTable::~PagedNodeTable() = default;

void PagedNodeTable::keepRoots()
{
  std::vector<Node> rows;
  for (const NodeIndex root : content_->roots)
  {
    rows.push_back(node(root));
  }
  content_->rootRows = std::move(rows);
}

NodeIndex PagedNodeTable::nodeCount() const
{
  return content_->nodes;
}

const std::vector<NodeIndex>& PagedNodeTable::roots() const
{
  return content_->roots;
}

Refinement PagedNodeTable::refinement() const
{
  return content_->refinement;
}

Node PagedNodeTable::node(NodeIndex index) const
{
  assert(index < content_->nodes);
  if (const Node* root = content_->rootRow(index))
  {
    return *root;
  }
  const std::uint32_t page = index / content_->pageRows;
  Node row;
  if (content_->setOf(page).copyRow(page, index % content_->pageRows, row))
  {
    return row;
  }
  NodePage rows;
  const bool sound = !content_->isLost(page) && content_->load(page, rows);
  return sound ? rows[index % content_->pageRows] : hollowRow;
}

Node PagedNodeTable::childOf(NodeIndex parent, const Node& row, std::uint8_t child) const
{
  const NodeIndex index = row.firstChild + child;
  const Node found = node(index);
  const bool lost = content_->isLost(index / content_->pageRows);
  return !lost && content_->linked(parent, row, index, found) ? found : hollowRow;
}

RowState PagedNodeTable::peekChild(
  NodeIndex parent, const Node& row, std::uint8_t child, Node& found) const
{
  const NodeIndex index = row.firstChild + child;
  const RowState state = peek(index, found);
  if (state == RowState::Here && !content_->linked(parent, row, index, found))
  {
    found = hollowRow;
    return RowState::Lost;
  }
  return state;
}

RowState PagedNodeTable::peek(NodeIndex index, Node& row) const
{
  assert(index < content_->nodes);
  if (const Node* root = content_->rootRow(index))
  {
    row = *root;
    return RowState::Here;
  }
  const std::uint32_t page = index / content_->pageRows;
  if (content_->setOf(page).copyRow(page, index % content_->pageRows, row))
  {
    return RowState::Here;
  }
  if (content_->isLost(page))
  {
    row = hollowRow;
    return RowState::Lost;
  }
  content_->want(page);
  return RowState::Coming;
}

std::uint64_t PagedNodeTable::arrivals() const
{
  return content_->arrivals;
}

bool PagedNodeTable::waitForArrival(
  std::uint64_t seen, std::chrono::steady_clock::time_point end) const
{
  Content& c = *content_;
  std::unique_lock<std::mutex> lock(c.wantedMutex);
  while (c.arrivals == seen && !(c.wanted.empty() && c.beingRead.empty()))
  {
    if (std::chrono::steady_clock::now() >= end)
    {
      return true;
    }
    if (c.readers.empty() && !c.wanted.empty())
    {
      lock.unlock();
      c.readNext();
      lock.lock();
    }
    else
    {
      c.changed.wait_until(lock, end);
    }
  }
  return c.arrivals != seen;
}

MissingRows* PagedNodeTable::missingRows() const
{
  return content_.get();
}

std::optional<Error> PagedNodeTable::fault() const
{
  if (!content_->damaged)
  {
    return std::nullopt;
  }
  const std::lock_guard<std::mutex> lock(content_->faultMutex);
  return content_->firstFault;
}

std::vector<Error> PagedNodeTable::takeFaults() const
{
  if (!content_->damaged)
  {
    return {};
  }
  const std::lock_guard<std::mutex> lock(content_->faultMutex);
  return std::exchange(content_->newFaults, {});
}

std::uint64_t PagedNodeTable::pagesRead() const
{
  return content_->pagesRead;
}

std::size_t PagedNodeTable::cachedBytes() const
{
  return content_->pagesHeld * sizeof(NodePage);
}

} // namespace pointfront
