#pragma once

#include "ImageValuesPass.h"

#include "pointfront/Base/Result.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront
{

/// The images that options name, and the library that reads them. That library, and with it 260
/// others that OpenImageIO needs, is loaded when an image is asked for: 0.3 s that no other command
/// should pay.
class RasterModule
{
public:
  /// `--color-from` and `--attribute-from` as given: files, patterns, folders. In the second, what
  /// stands before the first "=" names the attribute of that image and those that follow.
  /// Order    of the arguments, then of the names within a pattern or folder.
  /// Errors   NotFound; BadArgument: no attribute named, a name that cannot be taken, or an
  /// address,
  ///          which stays untold.
  static Result<std::vector<RasterInput>> inputs(
    const std::vector<std::string>& colourFrom, const std::vector<std::string>& attributeFrom);

  /// Errors   Unsupported: the library is not installed beside this program.
  static Result<std::unique_ptr<AttributePass>> load(const std::vector<RasterInput>& inputs,
    const std::shared_ptr<const CoordinateSystems>& systems);
};

} // namespace pointfront
