#pragma once

#include <cstddef>
#include <functional>

namespace pointfront
{

/// Rows of a node table that Hierarchy::peek() was asked for and that are on the disk. The table
/// does not read them itself: they take their turn with all else that is read (LoadScheduler).
/// Threads  all functions from any thread.
class MissingRows
{
public:
  virtual ~MissingRows() = default;
  /// Whether rows are asked for and nobody reads them.
  virtual bool waiting() const = 0;
  /// Reads the page of the rows that were asked for first; several where that takes no longer (a
  /// far source). May wait for the disk. Returns the bytes read; 0 when no row waits.
  virtual std::size_t readNext() = 0;

  /// Sets the `reader` of the rows: `wanted` is called, on the asking thread, when a first row is
  /// asked for, and must not call this object. Without a reader, threads that wait for rows read
  /// them.
  virtual void attach(const void* reader, std::function<void()> wanted) = 0;
  /// Removes the reader. Its function is not running any more when this returns.
  virtual void detach(const void* reader) = 0;
};

} // namespace pointfront
