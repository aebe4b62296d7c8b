#pragma once

#include "pointfront/Store/StoredCloud.h"

#include "vtkPointFrontReader.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <string>

namespace pointfront
{

/// Ends the program with a message.
[[noreturn]] void fail(const std::string& text);
/// Opens a store without an overview, with 4 GiB for its points. Ends the program if it cannot.
vtkSmartPointer<vtkPointFrontReader> openReader(const char* path);
/// All points of a store with an attribute rgb, in its order (a Morton order inside each node): one
/// poly-vertex, positions as doubles, colours as 3 x 8 bit. Ends the program if it cannot.
vtkSmartPointer<vtkPolyData> allPoints(const StoredCloud& store);

} // namespace pointfront
