#pragma once

#include "pointfront/Residency/MemoryBudget.h"
#include "pointfront/Residency/NodeCache.h"
#include "pointfront/Residency/RequestQueue.h"
#include "pointfront/Store/LayerColumns.h"
#include "pointfront/Store/NodeReader.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace pointfront
{

/// The reads of one store that wait: requests of its front, and nodes in memory that lack a
/// column that is wanted now. It knows how many bytes each needs and chooses what is read next.
/// Order    needed requests by priority, then re-reads for new columns, then optional requests; a
///          request that does not fit waits, smaller ones behind it go on. Nodes that are drawn
///          with old columns are read again before everything else.
/// Threads  none of its own: the owner locks.
class WaitingReads
{
public:
  /// Priority of a re-read of a node that is drawn with old columns.
  static constexpr double drawnNow = 1.0;

  struct Choice
  {
    LoadRequest request;
    int turn = 0; ///< lower ones go first; then larger priorities
    bool reread = false;
    bool inPlaceOfOld = false; ///< fits only after the node's old points are gone
  };
  /// The changes of a wish list. A node that is larger than the whole budget would wait for ever
  /// and in silence: it is taken off the list, and told with its bytes.
  struct Replaced
  {
    RequestQueue::Change change;
    std::vector<std::pair<NodeIndex, std::size_t>> tooLarge;
    std::size_t limit = 0; ///< bytes of the whole budget
  };

  WaitingReads(
    std::shared_ptr<const NodeReader> reader, std::shared_ptr<const MemoryBudget> budget);

  const LayerColumns& columns() const { return columns_; }
  /// Other columns are wanted from now on: `lacking` are the nodes in memory without them.
  void setColumns(const LayerColumns& columns, const std::vector<LoadRequest>& lacking);

  /// Takes the front's new wish list.
  Replaced replace(const std::vector<LoadRequest>& wanted);
  /// A node in memory lacks a column, or is now wanted with another priority.
  void readAgain(const LoadRequest& request);
  /// A node leaves the memory: its columns are of no interest any more.
  void cancelReread(NodeIndex node);
  /// The next read: it waits and fits. `oldMayGo`: nothing else can make room, so that the old
  /// points of a node in `cache` that nobody draws may go before its new ones come.
  std::optional<Choice> choose(const NodeCache& cache, bool oldMayGo) const;
  /// Needed requests that lie less than `reach` bytes from a node in the file, the nearest first;
  /// none where places are not known.
  std::vector<LoadRequest> near(NodeIndex node, std::uint64_t reach) const;
  /// Removes a request whose read begins.
  void take(const Choice& choice);
  void clear();

  /// Bytes in memory of what a request asks for.
  std::size_t need(const LoadRequest& request) const;
  /// A read has shown that NodeReader::decodedBytes() says too little of this node.
  void learn(NodeIndex node, std::size_t bytes);
  /// Whether a node that was too large may fit a budget of `limit` bytes.
  bool mayFit(NodeIndex node, std::size_t limit) const;

  std::size_t size() const { return queue_.size() + rereads_.size(); }
  std::size_t bytes() const; ///< bytes of all that does not wait for free memory

private:
  void noteLeastNeed();

  const std::shared_ptr<const NodeReader> reader_;
  const std::shared_ptr<const MemoryBudget> budget_;
  RequestQueue queue_;
  RequestQueue rereads_;
  LayerColumns columns_;
  /// Bytes of nodes of which decodedBytes() said too little, and of those that are too large.
  std::unordered_map<NodeIndex, std::size_t> needs_;
  std::size_t leastNeed_ = 0; ///< nothing that waits needs less
  mutable std::size_t bytes_ = 0;
  mutable bool bytesKnown_ = false; ///< `bytes_` is what bytes() says
};

} // namespace pointfront
