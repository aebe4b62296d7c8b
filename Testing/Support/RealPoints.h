#pragma once

#include "PointValues.h"

#include <cmath>
#include <cstdint>
#include <string>

namespace pointfront::test
{

/// A file of the public clouds (MANIFEST.md beside the data says what they hold).
inline std::string shared(const std::string& path)
{
  return POINTFRONT_SHARED_DATA "/" + path;
}

/// The facts of a file of the public clouds.
struct RealPoints
{
  const char* path;
  std::uint64_t points;
  const char* schema;
  std::uint64_t notFinite = 0; ///< points without a position
};

/// The format accepts the file and gives these points and attributes, those with a position inside
/// of the declared bounds. Null after a failure.
inline std::unique_ptr<PointSource> expectRealPoints(
  const PointSourceFormat& format, const RealPoints& expected)
{
  EXPECT_TRUE(format.accepts(shared(expected.path)));
  auto source = openPoints(format, shared(expected.path));
  if (!source)
  {
    return nullptr;
  }
  EXPECT_EQ(source->description().pointCount, expected.points);
  EXPECT_EQ(schemaText(*source), expected.schema);
  std::uint64_t notFinite = 0;
  for (const glm::dvec3& p : readPoints(*source).positions)
  {
    const bool finite = std::isfinite(p.x + p.y + p.z);
    notFinite += finite ? 0 : 1;
    EXPECT_TRUE(!finite || source->description().declaredBounds.contains(p));
  }
  EXPECT_EQ(notFinite, expected.notFinite);
  return source;
}

} // namespace pointfront::test
