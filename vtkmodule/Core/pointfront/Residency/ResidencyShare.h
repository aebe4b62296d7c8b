#pragma once

#include "pointfront/Residency/Residency.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <vector>

namespace pointfront
{

/// One residency that several fronts share: each view of each mapper that draws a store has a front
/// of its own, and all of them share the loaded nodes.
/// Wishes      the residency gets the union of the wishes: all wanted nodes, each with the largest
///             priority that any front gives it, optional if it is optional for all; and the union
///             of the columns. It keeps every node that a front needs (the smallest distance under
///             any front counts).
/// Threads     one thread (the renderer's), as Residency.
class ResidencyShare
{
public:
  /// Levels that a node lies below a front; 0: the front needs it.
  using Distance = std::function<std::uint32_t(NodeIndex)>;

  /// The present wish of one front. Destruction withdraws it.
  class Wish
  {
  public:
    ~Wish();
    Wish(const Wish&) = delete;
    Wish& operator=(const Wish&) = delete;

    /// Columns that this front draws with; the residency reads them from now on.
    void setColumns(const ColumnSelection& columns) { setLayerColumns(columns); }
    void setLayerColumns(const LayerColumns& columns);
    /// `distance` is asked until the wish is changed or withdrawn.
    void request(const std::vector<LoadRequest>& requests, Distance distance);

  private:
    friend class ResidencyShare;
    explicit Wish(ResidencyShare& share);
    ResidencyShare& share_;
    LayerColumns columns_;
    std::vector<LoadRequest> requests_;
    Distance distance_;
  };

  /// With a scheduler of its own.
  ResidencyShare(
    std::shared_ptr<const NodeReader> reader, NodeIndex nodeCount, const ResidencyOptions& options);
  /// One of several stores of a scheduler; `points` is its size.
  ResidencyShare(std::shared_ptr<const NodeReader> reader, NodeIndex nodeCount,
    std::shared_ptr<LoadScheduler> scheduler, std::uint64_t points);
  ~ResidencyShare();
  ResidencyShare(const ResidencyShare&) = delete;
  ResidencyShare& operator=(const ResidencyShare&) = delete;

  /// A new front joins. The share must outlive its wishes.
  std::unique_ptr<Wish> join();

  Residency& residency() { return residency_; }
  const Residency& residency() const { return residency_; }
  /// Fronts that have joined.
  std::size_t wishes() const { return wishes_.size(); }
  /// The store's own budget or the scheduler's: the lower one.
  std::size_t budgetBytes() const { return residency_.budgetBytes(); }
  void setBudgetBytes(std::size_t bytes) { residency_.setBudgetBytes(bytes); }

private:
  void updateColumns();
  void updateRequests();

  Residency residency_;
  std::vector<Wish*> wishes_;
  std::map<NodeIndex, LoadRequest> merged_; ///< scratch of updateRequests()
};

} // namespace pointfront
