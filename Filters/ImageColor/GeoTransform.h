#pragma once

#include <glm/vec2.hpp>

#include <optional>

namespace pointfront
{

/// Where the pixels of an image lie on the ground: ground = origin + column * u + row * v, counted
/// from the upper left CORNER of the upper left pixel (GDAL's convention, and GeoTIFF's
/// PixelIsArea). Rows go down; u and v may be turned.
class GeoTransform
{
public:
  /// Nothing when u and v are parallel, or anything is not finite.
  static std::optional<GeoTransform> fromCorner(
    const glm::dvec2& origin, const glm::dvec2& u, const glm::dvec2& v);
  /// `centre` is that of the upper left pixel: world files, and GeoTIFF's PixelIsPoint.
  static std::optional<GeoTransform> fromCentre(
    const glm::dvec2& centre, const glm::dvec2& u, const glm::dvec2& v);

  glm::dvec2 toGround(const glm::dvec2& pixel) const
  {
    return { origin_.x + pixel.x * u_.x + pixel.y * v_.x,
      origin_.y + pixel.x * u_.y + pixel.y * v_.y };
  }
  /// (column, row) with fractions: the pixel that holds a point is the floor of both.
  glm::dvec2 toPixel(const glm::dvec2& ground) const
  {
    const double x = ground.x - origin_.x;
    const double y = ground.y - origin_.y;
    return { (x * v_.y - y * v_.x) / determinant_, (y * u_.x - x * u_.y) / determinant_ };
  }

private:
  glm::dvec2 origin_{ 0.0 };
  glm::dvec2 u_{ 0.0 };
  glm::dvec2 v_{ 0.0 };
  double determinant_ = 1.0;
};

} // namespace pointfront
