#pragma once

#include "pointfront/Store/NodeReader.h"
#include "pointfront/Threads/WorkerThread.h"

#include <condition_variable>
#include <cstddef>
#include <exception>
#include <memory>
#include <mutex>
#include <vector>

namespace pointfront
{

/// Fetches nodes from afar: neighbours in the list make a group, which is one call of fetchAll(),
/// and several groups are under way at a time. Who decodes takes nodes while later ones come.
/// Groups   as many nodes as come to `bytesAtOnce` of the reader's cost, and one at least; as many
///          at a time as the reader takes, `mostAtOnce` at most, each on a thread that waits.
/// Order    the nodes are handed out in the order of the list, each once.
/// Memory   up to all nodes of the list, as they lie in the source.
/// Threads  one thread calls next(). Destruction stops what is under way and waits for its end.
class GroupedFetch
{
public:
  static constexpr std::size_t mostAtOnce = 32;

  /// `bytes`: of each node in the source. The reader and `stop` must outlive this object.
  GroupedFetch(const NodeReader& reader, std::vector<WantedNode> wanted,
    const std::vector<std::size_t>& bytes, ReadStop& stop);
  ~GroupedFetch();
  GroupedFetch(const GroupedFetch&) = delete;
  GroupedFetch& operator=(const GroupedFetch&) = delete;

  /// The next nodes of the list that are there: waits for one group at least. Empty at the end.
  std::vector<Result<FetchedNode>> next();

private:
  struct Group
  {
    std::size_t first = 0; ///< in wanted_
    std::size_t count = 0;
    std::vector<Result<FetchedNode>> fetched;
    std::exception_ptr fault;
    bool done = false;
  };

  void work();
  void fetch(Group& group) const;

  const NodeReader& reader_;
  const std::vector<WantedNode> wanted_;
  ReadStop& stop_;
  std::mutex mutex_; ///< guards all that follows, but for groups that a thread has taken
  std::condition_variable come_;
  std::vector<Group> groups_;
  std::size_t begun_ = 0; ///< groups that a thread has taken
  std::size_t given_ = 0; ///< groups that next() has handed out
  std::vector<std::unique_ptr<WorkerThread>> threads_;
};

} // namespace pointfront
