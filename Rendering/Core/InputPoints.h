#pragma once

class vtkPointFrontStore;
class vtkPolyDataMapper;

namespace pointfront
{

/// Whether the points of a mapper's input are others than its store's reader gave: a filter passes
/// the store's name on with points that it moved, chose or made. Filters that keep the points, and
/// data that somebody hands on, are no change.
bool hasOtherPoints(vtkPolyDataMapper& mapper, vtkPointFrontStore& store);

} // namespace pointfront
