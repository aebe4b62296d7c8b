#include "PixelRays.h"

#include "RandomStream.h"

namespace pointfront::truth
{

PixelRays::PixelRays(const TruthCamera& camera, std::uint32_t width, std::uint32_t height)
  : width_(width)
  , height_(height)
  , focalPx_(0.5 * height / std::tan(0.5 * camera.viewAngleDegrees * pi / 180.0))
  , eye_(camera.position)
  , forward_(glm::normalize(camera.focalPoint - camera.position))
  , right_(glm::normalize(glm::cross(forward_, camera.viewUp)))
  , down_(glm::cross(forward_, right_))
{
}

glm::dvec3 PixelRays::through(double x, double y) const
{
  return forward_ + (x - 0.5 * width_) / focalPx_ * right_ + (y - 0.5 * height_) / focalPx_ * down_;
}

glm::dvec3 PixelRays::project(const glm::dvec3& place) const
{
  const glm::dvec3 seen = place - eye_;
  const double depth = glm::dot(seen, forward_);
  return { 0.5 * width_ + focalPx_ * glm::dot(seen, right_) / depth,
    0.5 * height_ + focalPx_ * glm::dot(seen, down_) / depth, depth };
}

bool PixelRays::mayShow(const glm::dvec3& centre, double radius, double marginPx) const
{
  const glm::dvec3 seen = centre - eye_;
  const double depth = glm::dot(seen, forward_);
  const auto within = [&](const glm::dvec3& axis, double pixels)
  {
    const double slope = (0.5 * pixels + marginPx) / focalPx_;
    return std::abs(glm::dot(seen, axis)) <=
      slope * depth + radius * std::sqrt(1.0 + slope * slope);
  };
  return depth > -radius && within(right_, width_) && within(down_, height_);
}

} // namespace pointfront::truth
