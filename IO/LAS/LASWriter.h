#pragma once

#include "pointfront/Points/PointSink.h"

#include <memory>
#include <string>

namespace pointfront
{

/// Writes points as LAS, or as LAZ through LASzip. The point format is the smallest that holds the
/// schema's attributes: LAS 1.2 formats 0 to 3, LAS 1.3 formats 4 and 5, LAS 1.4 formats 6 to 10
/// (also when there are more than 2^32 - 1 points, classes above 31, or more than 7 returns).
/// Attributes that are not LAS fields become extra bytes with their descriptor record.
/// Exactness   the integers of the grid, and every attribute that came from a LAS file, are written
///             as they were; colour of 8 bit is written as it is, not spread over 16 bit.
/// Threads     one thread.
std::unique_ptr<PointSink> makeLASWriter(const std::string& path);
/// The same points, compressed: chunks of 50,000 points.
std::unique_ptr<PointSink> makeLAZWriter(const std::string& path);

} // namespace pointfront
