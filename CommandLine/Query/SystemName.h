#pragma once

#include "pointfront/Reference/GeoKeys.h"

#include <string>

namespace pointfront
{

/// A coordinate reference system as people call it, of its well-known text (WKT 1 or 2):
/// "EPSG:2154 (RGF93 / Lambert-93)"; of a compound one without a code "EPSG:2154 + EPSG:5720
/// (...)". Without any code its name; text that is no WKT as it is.
std::string systemName(const std::string& wkt);

/// The same of a LAS file's GeoTIFF keys, as far as these say it: the codes as they stand there,
/// and the citation.
std::string systemName(const GeoKeys& keys);

} // namespace pointfront
