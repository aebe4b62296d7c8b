#pragma once

#include "pointfront/Disk/ByteTraffic.h"

#include "vtkType.h"

#include <cstdint>
#include <string>

class vtkPolyData;

namespace pointfront
{

class StoredCloud;

/// A number for people: 10,653,336.
std::string groupedDigits(std::uint64_t number);

/// The traffic with servers so far, for people: "34 requests, 1.2 MB; 0.3 MB from the cache". Empty
/// if neither a server nor the cache was asked. `missing`: nodes of a picture that could not be
/// had.
std::string trafficText(const TrafficCounts& traffic, std::uint64_t missing);

/// Describes the store, in lines for a panel: points, bounds, coordinate reference system,
/// structure, classes with their points (of a store with a tree for each class), attributes'
/// ranges; and that the output, whose points the Information panel counts, is an overview, if it is
/// one. `mostOverviewPoints` is the reader's limit.
std::string storeFacts(const StoredCloud& store, std::int64_t mostOverviewPoints);

/// The frame of the coordinates as field data: "store_crs", and "store_grid", the scales and
/// offsets of the grid that they lie on. Writers keep both.
void addStoreFrame(const StoredCloud& store, vtkPolyData* output);

/// storeFacts() and the frame as field data of the reader's output, and "output_is": what the
/// points of the output are. `mostOverviewPoints` is the reader's limit.
void addStoreFacts(const StoredCloud& store, vtkIdType mostOverviewPoints, vtkPolyData* output);

/// Puts point arrays that tell the ranges of the whole store in place of an overview's, so that
/// colour maps, thresholds and histograms span what the store has. The overview alone lacks most
/// extremes. Of vectors the components' ranges are the store's and that of the length is the
/// overview's; the colours "rgb" keep the overview's. The points' bounds are the store's likewise.
void setStoreRanges(const StoredCloud& store, vtkPolyData* output);

} // namespace pointfront
