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
  /// Whether some are asked for and nobody reads them.
  virtual bool waiting() const = 0;
  /// Reads those that were asked for first, one page. May wait for the disk. Bytes read; 0 when
  /// nothing waits any more.
  virtual std::size_t readNext() = 0;

  /// From now on `reader` sees to it that they are read: `wanted` is called when the first is asked
  /// for, by who asks, and must not call this object. Without a reader who waits for rows reads
  /// them.
  virtual void attach(const void* reader, std::function<void()> wanted) = 0;
  /// Its function is not running any more then.
  virtual void detach(const void* reader) = 0;
};

} // namespace pointfront
