#pragma once

#include <string>

namespace pointfront::test
{

/// The folder of public images from above, with its slash.
inline const std::string ortho = POINTFRONT_SHARED_DATA "/ortho/";

} // namespace pointfront::test
