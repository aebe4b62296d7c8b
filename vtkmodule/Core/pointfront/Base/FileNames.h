#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>

#include <sys/types.h>

namespace pointfront
{

/// The file that a symbolic link leads to: what lies beside that is found, and a change replaces it
/// and not the link. Any other path, and a link to nothing, as it is.
std::string followedLink(const std::string& path);

/// Knows a file again under any of its names: another way to write the path, a symbolic or a hard
/// link, a linked folder. Addresses, and paths where nothing is, are known by their text.
class FileNames
{
public:
  /// The first name that the file was added by; nothing: it is new.
  std::optional<std::string> add(const std::string& path);

private:
  std::map<std::pair<dev_t, ino_t>, std::string> files_;
  std::map<std::string, std::string> others_;
};

} // namespace pointfront
