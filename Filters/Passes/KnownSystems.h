#pragma once

#include "pointfront/Points/AttributePass.h"
#include "pointfront/Points/PassChoice.h"
#include "pointfront/Points/PointSink.h"
#include "pointfront/Reference/CoordinateSystems.h"

#include <memory>
#include <string>

namespace pointfront
{

/// The coordinate reference systems that this build knows: PROJ's. In a build without PROJ none:
/// every definition is Unsupported there, and two systems are equivalent if their text is the same.
/// Never null.
std::shared_ptr<const CoordinateSystems> knownSystems();

/// The pass that gives all inputs one system, by what PassChoice says of it. Without PROJ it gives
/// the inputs on as they are, with a finding, if all that name a system name the same. Errors
/// Unsupported: a build without PROJ, and a system is named.
Result<std::unique_ptr<AttributePass>> oneSystemPass(const PassChoice& choice);

/// A sink whose points are transformed into the system `target` first. `assumedName`: what a
/// message calls the choice of a build that names a system for inputs without one. Errors
/// Unsupported: a build without PROJ.
Result<std::unique_ptr<PointSink>> sinkInSystem(
  std::unique_ptr<PointSink> sink, const std::string& target, const std::string& assumedName);

} // namespace pointfront
