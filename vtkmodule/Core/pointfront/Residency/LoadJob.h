#pragma once

#include "pointfront/Residency/StoreNodes.h"
#include "pointfront/Store/NodeReader.h"

#include <cstddef>
#include <memory>
#include <vector>

namespace pointfront
{

/// One read of a store: it gets nodes, which are fetched in one go and then decoded one after
/// another, or a page of rows of the node table. Its nodes count as loading until run() or giveUp()
/// has returned.
/// Threads  one at a time.
class LoadJob
{
public:
  /// Hears how far a job is.
  class Listener
  {
  public:
    virtual ~Listener() = default;
    /// The read has ended, once a job, whether it succeeded or not. `bytes` of the file.
    virtual void fetched(std::size_t bytes) = 0;
    /// A node has been decoded, which took `seconds` of this thread, into `bytes` of memory; 0 for
    /// a node that failed.
    virtual void decoded(double seconds, std::size_t bytes) = 0;
    /// Who waits for something of the store should look again.
    virtual void changed() = 0;
  };

  /// Takes what is most urgent of the store's requests, if it fits: one node or page of a disk;
  /// nodes up to `bytes` in memory of a far source, which share a stop.
  LoadJob(std::shared_ptr<StoreNodes> store, bool far, std::size_t bytes);

  bool empty() const { return tasks_.empty(); }
  StoreNodes& store() const { return *store_; }
  /// Null: of a disk.
  const std::shared_ptr<ReadStop>& stop() const { return stop_; }

  /// Errors  those of a node are the store's. What else is thrown (no memory) is thrown on: then
  ///         the nodes that are still to be done have failed.
  void run(Listener& listener);
  /// Instead of run().
  void giveUp();

private:
  void readRows(Listener& listener);
  void loadNodes(Listener& listener);
  std::vector<Result<FetchedNode>> fetch() const;
  void finish(Result<FetchedNode> fetched, Listener& listener);
  void endFetch(Listener& listener, std::size_t bytes);

  std::shared_ptr<StoreNodes> store_;
  std::vector<StoreNodes::Task> tasks_;
  std::shared_ptr<ReadStop> stop_;
  bool fetching_ = true;
  std::size_t kept_ = 0; ///< tasks of which the store has the node, or knows why not
  std::size_t left_ = 0; ///< tasks that are no longer loading
};

} // namespace pointfront
