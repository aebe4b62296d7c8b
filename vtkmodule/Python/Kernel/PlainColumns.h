#pragma once

#include "pointfront/Query/QueryBatch.h"
#include "pointfront/Store/StoredCloud.h"

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// Chosen points as plain columns: places, ids in the store, attributes. Values are what is
/// stored, in their type; those of an attribute with a scale become float64.
/// Memory   each point once. While columns grow they are larger than what is in them; the system
///          gives memory to what was written only.
/// Threads  one.
class PlainColumns
{
public:
  /// Memory of malloc(): who takes it frees it.
  struct Free
  {
    void operator()(void* memory) const { std::free(memory); }
  };
  struct Column
  {
    std::string name; ///< empty: places; "id": numbers in the store, unless it is behind these two
    ScalarType type = ScalarType::Float64;
    std::size_t components = 1;
    std::unique_ptr<void, Free> memory = {};
  };

  /// `description` has the schema of the batches.
  PlainColumns(const StoreDescription& description, std::uint64_t mostPoints);

  /// NoMemory where they would be more than `mostPoints`, or the system gives no more.
  Result<void> add(const QueryBatch& batch);

  std::uint64_t points() const { return points_; }
  /// No larger than their points, from now on the caller's.
  std::vector<Column> take();

private:
  static std::size_t bytesOf(const Column& column);
  bool resize(std::uint64_t points);
  void fill(std::size_t column, const std::byte* from, std::uint64_t first, std::size_t count);

  AttributeSchema schema_;
  std::uint64_t mostPoints_;
  std::uint64_t points_ = 0;
  std::uint64_t room_ = 0;
  std::vector<Column> columns_; ///< places, ids, the schema's
};

} // namespace pointfront
