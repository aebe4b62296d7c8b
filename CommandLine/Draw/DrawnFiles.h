#pragma once

#include "pointfront/Export/OutputTarget.h"

#include <string>
#include <vector>

namespace pointfront
{

/// Asked by `render` and `bench` before they draw: each target can be written (checkWritable), none
/// is another or is what is read (checkOutputTarget), be it the file behind an index. What is there
/// of the same kind is replaced.
/// `targets`  those with an empty path are none.
/// `clouds`   what is drawn; `others`: cameras and the like.
Result<void> checkDrawnFiles(const std::vector<OutputTarget>& targets,
  const std::vector<std::string>& clouds, const std::vector<std::string>& others);

} // namespace pointfront
