#pragma once

#include "pointfront/Base/Error.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace pointfront
{

/// The lines of a text header in front of points (PLY, PCD), one by one. `text` and `path` outlive
/// this object.
class HeaderLines
{
public:
  using Words = std::vector<std::string_view>;

  /// Reads the first MiB of `text` at most.
  HeaderLines(std::string_view text, const std::string& path);

  /// Goes to the next line; false where the text has no whole line any more.
  bool next();
  /// The words of the line, between blanks.
  Words words() const;
  std::uint64_t number() const { return number_; } ///< number of the line, from 1
  std::size_t behind() const { return behind_; } ///< offset of the byte behind the line
  std::size_t size() const { return text_.size(); } ///< bytes that are read at most

  const std::string& path() const { return path_; }
  /// An error that names the line.
  Error fault(Error::Kind kind, const std::string& what) const;

private:
  std::string_view text_;
  const std::string& path_;
  std::string_view line_;
  std::uint64_t number_ = 0;
  std::size_t behind_ = 0;
};

} // namespace pointfront
