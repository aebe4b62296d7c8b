#pragma once

#include "ImageValuesPass.h"

#include "pointfront/Points/PointSource.h"

#include <memory>
#include <string>
#include <vector>

namespace pointfront::test
{

/// The points that a pass of image values gives, chunk after chunk, and what it said.
struct ColouredCloud
{
  PointBatch points;
  AttributeSchema schema;
  std::string error;
  std::string colourImage; ///< SourceDescription::colourImage
  std::string findings; ///< one a line

  /// All components of an attribute, point after point.
  std::vector<double> values(const std::string& name) const;
};

/// Gives `source` the values of images. The cache of tiles is the smallest that there is.
ColouredCloud coloured(std::unique_ptr<PointSource> source, std::vector<RasterInput> inputs);

/// A LAS file; null, and a failure of the test, where it cannot be opened.
std::unique_ptr<PointSource> opened(const std::string& path);

/// A cloud in memory, without attributes.
std::unique_ptr<PointSource> cloud(std::vector<glm::dvec3> points, const std::string& wkt = "");

} // namespace pointfront::test
