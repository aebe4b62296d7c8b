#include "pointfront/Query/Orientation.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace pointfront
{
namespace
{

int signOf(double value)
{
  return value > 0.0 ? 1 : value < 0.0 ? -1 : 0;
}

/// A sum of doubles without rounding: its parts do not overlap and grow in magnitude, so the last
/// one that is not 0 has the sign of all.
class ExactSum
{
public:
  void addProduct(double x, double y)
  {
    const double product = x * y;
    add(std::fma(x, y, -product));
    add(product);
  }
  int sign() const
  {
    for (std::size_t i = size_; i-- > 0;)
    {
      if (parts_[i] != 0.0)
      {
        return signOf(parts_[i]);
      }
    }
    return 0;
  }

private:
  void add(double value)
  {
    for (std::size_t i = 0; i < size_; ++i)
    {
      const double sum = value + parts_[i];
      const double rest = sum - value;
      parts_[i] = (value - (sum - rest)) + (parts_[i] - rest);
      value = sum;
    }
    parts_[size_++] = value;
  }

  std::array<double, 12> parts_{};
  std::size_t size_ = 0;
};

/// (b - a) x (p - a) as six products: differences would round.
int exactOrientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p)
{
  ExactSum sum;
  sum.addProduct(a.x, b.y);
  sum.addProduct(-a.y, b.x);
  sum.addProduct(b.x, p.y);
  sum.addProduct(-b.y, p.x);
  sum.addProduct(p.x, a.y);
  sum.addProduct(-p.y, a.x);
  return sum.sign();
}

} // namespace

int orientation(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& p)
{
  constexpr double unit = 0.5 * std::numeric_limits<double>::epsilon();
  constexpr double relativeError = (3.0 + 16.0 * unit) * unit;
  const double left = (a.x - p.x) * (b.y - p.y);
  const double right = (a.y - p.y) * (b.x - p.x);
  const double determinant = left - right;
  if (std::abs(determinant) > relativeError * (std::abs(left) + std::abs(right)))
  {
    return signOf(determinant);
  }
  return exactOrientation(a, b, p);
}

} // namespace pointfront
