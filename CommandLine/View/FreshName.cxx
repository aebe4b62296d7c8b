#include "FreshName.h"

#include <filesystem>

namespace pointfront
{

std::string freshName(const std::string& stem, const std::string& extension)
{
  std::string name;
  std::error_code unreadable;
  int number = 0;
  do
  {
    name = stem + "-" + std::to_string(++number) + extension;
  } while (std::filesystem::symlink_status(name, unreadable).type() !=
      std::filesystem::file_type::not_found &&
    !unreadable);
  return name;
}

} // namespace pointfront
