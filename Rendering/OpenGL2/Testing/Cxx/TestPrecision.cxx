#include "Scene.h"

using namespace pointfront;
using namespace pointfront::test;

namespace
{

Sample hill(std::size_t i)
{
  Random random(1000 + i);
  Sample sample;
  sample.position = { std::llround(4000.0 * random.uniform() - 2000.0),
    std::llround(4000.0 * random.uniform() - 2000.0), 0 };
  sample.position.z = (sample.position.x * sample.position.y) / 4000;
  sample.rgb = { static_cast<std::uint8_t>(random.next()), static_cast<std::uint8_t>(random.next()),
    static_cast<std::uint8_t>(random.next()) };
  return sample;
}

TEST(Precision, TheSceneLooksTheSameAtTheOriginAndFarFromIt)
{
  const glm::dvec3 far(1e7, 1e7, 1e3);
  Scene near(storeOf("near", 40000, hill));
  Scene away(storeOf("away", 40000, hill, far), far);
  // Eyes on multiples of 1/1024, which are exact at both places.
  for (const glm::dvec3& eye : { glm::dvec3(0.0, 0.0, 10.0), glm::dvec3(3.0625, -2.5, 1.125),
         glm::dvec3(0.5, 0.25, 0.0625 + 0.5) })
  {
    near.lookFrom(eye, glm::dvec3(0.0));
    away.lookFrom(far + eye, far);
    const Picture a = near.draw();
    const Picture b = away.draw();
    EXPECT_GT(a.lit(), 1000);
    EXPECT_EQ(differing(a, b), 0);
  }
}

TEST(Precision, NothingJittersWhenTheCameraMovesByFractionsOfAMillimetre)
{
  // 50 points in a row, 1 mm apart, seen from 20 mm: 750 pixels a unit of the view plane at 1.
  const glm::dvec3 far(1e7, 1e7, 1e3);
  const auto store = storeOf(
    "jitter", 50,
    [](std::size_t i)
    {
      Sample sample;
      sample.position = { static_cast<int>(i) - 25, 0, 0 };
      return sample;
    },
    far);
  Scene scene(store, far);
  scene.renderer->GetActiveCamera()->SetClippingRange(0.001, 1.0);
  for (int step = 0; step < 20; ++step)
  {
    // Steps of 1/16384 m = 0.06 mm are exact in double at 1e7 (spacing of doubles there: 1.9e-9).
    const double x = step / 16384.0;
    const glm::dvec3 eye = far + glm::dvec3(x, 0.0, 0.03125);
    scene.lookFrom(eye, far + glm::dvec3(x, 0.0, 0.0));
    scene.renderer->GetActiveCamera()->SetClippingRange(0.001, 1.0);
    const Picture picture = scene.draw();
    // The right pixel columns, computed relative to the eye.
    const double pixels = 100.0 / std::tan(15.0 * 3.14159265358979323846 / 180.0) / 0.03125;
    int wrong = 0;
    int seen = 0;
    for (int i = -25; i < 25; ++i)
    {
      const double column = 150.0 + (0.001 * i - x) * pixels;
      const double fraction = column - std::floor(column);
      if (column < 1.0 || column > 298.0 || fraction < 0.02 || fraction > 0.98)
      {
        continue; // on the border of two pixels
      }
      ++seen;
      const int at = static_cast<int>(std::floor(column));
      wrong += picture.at(at, 100)[0] == 255 || picture.at(at, 99)[0] == 255 ? 0 : 1;
    }
    EXPECT_EQ(wrong, 0) << "step " << step;
    EXPECT_GT(seen, 15);
  }
}

} // namespace
