#include "pointfront/Table/HeaderLines.h"

#include <algorithm>

namespace pointfront
{
namespace
{
constexpr std::size_t mostHeaderBytes = 1 << 20;
} // namespace

HeaderLines::HeaderLines(std::string_view text, const std::string& path)
  : text_(text.substr(0, mostHeaderBytes))
  , path_(path)
{
}

bool HeaderLines::next()
{
  const std::size_t end = text_.find('\n', behind_);
  if (end == std::string_view::npos)
  {
    return false;
  }
  line_ = text_.substr(behind_, end - behind_);
  behind_ = end + 1;
  ++number_;
  return true;
}

HeaderLines::Words HeaderLines::words() const
{
  Words words;
  constexpr std::string_view blanks = " \t\r";
  for (std::size_t begin = line_.find_first_not_of(blanks); begin != std::string_view::npos;)
  {
    const std::size_t end = std::min(line_.find_first_of(blanks, begin), line_.size());
    words.push_back(line_.substr(begin, end - begin));
    begin = line_.find_first_not_of(blanks, end);
  }
  return words;
}

Error HeaderLines::fault(Error::Kind kind, const std::string& what) const
{
  return makeError(kind, path_ + ": line " + std::to_string(number_) + ": " + what);
}

} // namespace pointfront
