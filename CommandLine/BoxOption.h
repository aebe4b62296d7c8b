#pragma once

#include "pointfront/Base/Bounds.h"

#include <functional>
#include <string>

namespace CLI
{
class App;
}

namespace pointfront
{

/// `--box x0,y0,z0,x1,y1,z1`. What is not six numbers, the lower corner first, is wrong usage.
void declareBox(
  CLI::App& app, const std::string& help, const std::function<void(const Bounds&)>& take);

} // namespace pointfront
