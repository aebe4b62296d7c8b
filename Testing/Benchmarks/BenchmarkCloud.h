#pragma once

#include "pointfront/Store/StoredCloud.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>

namespace pointfront
{

/// Ends the program with a message.
[[noreturn]] void fail(const std::string& text);
/// All points of a store with an attribute rgb, in its order (a Morton order inside each node): one
/// poly-vertex, positions as doubles, colours as 3 x 8 bit. Ends the program if it cannot.
vtkSmartPointer<vtkPolyData> allPoints(const StoredCloud& store);

} // namespace pointfront
