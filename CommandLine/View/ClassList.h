#pragma once

#include "pointfront/Base/Result.h"
#include "pointfront/Store/StoredCloud.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// The classes of the stores, each shown or hidden, and the one that the user is at.
class ClassList
{
public:
  /// `shown`  sorted codes; empty: all.
  /// Errors   of reading a sample of a store that has one tree for all classes: its classes are
  ///          those of the sample.
  static Result<ClassList> of(const std::vector<std::shared_ptr<const StoredCloud>>& stores,
    const std::vector<std::uint8_t>& shown);

  bool empty() const { return entries_.empty(); }
  void move(int steps);
  /// Shows or hides the class; the last one that is shown stays.
  void toggle();
  /// Sorted codes of what is shown; empty: all.
  std::vector<std::uint8_t> shown() const;
  /// A line for each class.
  std::string text() const;

private:
  struct Entry
  {
    std::uint8_t code = 0;
    bool shown = true;
  };
  std::vector<Entry> entries_; ///< by code
  std::size_t at_ = 0;
};

} // namespace pointfront
