#pragma once

#include "Scene.h"

#include "pointfront/Points/SplatRadius.h"
#include "vtkPointFrontStyle.h"

#include <glm/geometric.hpp>

#include <array>
#include <map>
#include <string>

namespace pointfront::test
{

struct Surfel
{
  glm::dvec3 position;
  glm::dvec3 normal;
};
using Surface = Surfel (*)(double u, double v); ///< u, v in [0, 1]

inline Surfel planeAt(double u, double v)
{
  return { { 4.0 * u - 2.0, 4.0 * v - 2.0, 0.3 * u },
    glm::normalize(glm::dvec3(-0.075, 0.0, 1.0)) };
}

inline Surfel sphereAt(double u, double v)
{
  const double height = 2.0 * u - 1.0;
  const double around = 6.283185307 * v;
  const double wide = std::sqrt(1.0 - height * height);
  const glm::dvec3 normal(wide * std::cos(around), wide * std::sin(around), height);
  return { 1.5 * normal, normal };
}

inline Surfel stairsAt(double u, double v)
{
  const double along = 8.0 * u;
  const double step = std::floor(along);
  const double part = along - step;
  const bool tread = part < 0.5;
  const double x = 0.5 * step + (tread ? part : 0.5);
  const double z = 0.4 * step + (tread ? 0.0 : 0.8 * (part - 0.5));
  return { { x - 2.0, 4.0 * v - 2.0, z - 1.5 },
    tread ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(-1.0, 0.0, 0.0) };
}

/// A roof at a height of 40, and the ground; its walls are 8.3 high (surfaceStore).
inline Surfel roofAt(double u, double v)
{
  const bool roof = u >= 0.5;
  return { { 4.0 * (roof ? 2.0 * u - 1.0 : 2.0 * u) - 2.0, 4.0 * v - 2.0, roof ? 40.0 : 0.0 },
    { 0.0, 0.0, 1.0 } };
}

/// 40,000 points with normals, radii, sizes, colours and two classes. One in 97 has no normal.
inline std::string surfaceStore(const std::string& name, Surface surface)
{
  constexpr int side = 200;
  AttributeSchema schema;
  schema.add({ "rgb", ScalarType::UInt8, 3 });
  schema.add({ "classification", ScalarType::UInt8, 1 });
  Attribute normal{ "normal", ScalarType::Int16, 3 };
  normal.scale = 1.0 / 32767.0;
  schema.add(normal);
  schema.add(splatRadiusColumn());
  schema.add({ "reach", ScalarType::Float32, 1 });
  schema.add({ "height_above_ground", ScalarType::Float32, 1 });
  const QuantisationGrid grid = millimetres(glm::dvec3(0.0));
  auto cloud = std::make_unique<CloudSource>(name, schema, grid);
  for (int i = 0; i < side * side; ++i)
  {
    const double u = (i % side + 0.25 * (i / side % 4)) / side;
    const double v = (i / side + 0.5) / side;
    const Surfel surfel = surface(u, v);
    cloud->addPosition(surfel.position);
    const auto byte = [](double x) { return static_cast<std::uint8_t>(255.0 * x); };
    cloud->addValue(0, std::array<std::uint8_t, 3>{ byte(u), byte(v), byte(0.5 * (u + v)) });
    cloud->addValue(1, static_cast<std::uint8_t>(v < 0.5 ? 2 : 6));
    std::array<std::int16_t, 3> stored{};
    for (int axis = 0; axis < 3 && i % 97 != 0; ++axis)
    {
      stored[static_cast<std::size_t>(axis)] =
        static_cast<std::int16_t>(std::lround(32767.0 * surfel.normal[axis]));
    }
    cloud->addValue(2, stored);
    cloud->addValue(3, i % 89 == 0 ? unknownSplatRadius : encodeSplatRadius(0.02 + 0.01 * u, 0.02));
    cloud->addValue(4, static_cast<float>(0.01 + 0.03 * v));
    cloud->addValue(5, static_cast<float>(i % 7 == 0 ? 0.0 : 0.3 + 0.2 * surfel.position.z));
  }
  cloud->editDescription().splatRadiusBase = 0.02;
  return builtStore(name, std::move(cloud));
}

struct Splats : Scene
{
  vtkNew<vtkPointFrontStyle> style;

  explicit Splats(const std::string& store)
    : Scene(store)
  {
    lookFrom({ 3.0, -5.0, 4.0 }, { 0.0, 0.0, 0.0 });
    mapper->SetStyle(style);
    mapper->SetTargetError(2.0);
  }
  Picture with(int backend)
  {
    mapper->SetBackend(backend);
    return draw();
  }
  /// Nearly all pixels alike; the rest are those where two splats are equally near but for
  /// rounding, and rims.
  void expectAlike(const std::string& what, int tolerance = 2)
  {
    constexpr double share = 0.995;
    const Picture software = with(vtkPointFrontMapper::SOFTWARE);
    const Picture gl = with(vtkPointFrontMapper::OPENGL);
    const double pixels = static_cast<double>(gl.width) * gl.height;
    EXPECT_GT(gl.lit(), 4000) << what;
    EXPECT_LE(differing(software, gl, tolerance), (1.0 - share) * pixels) << what;
  }
  void setParallel(bool parallel)
  {
    renderer->GetActiveCamera()->SetParallelProjection(parallel);
    renderer->GetActiveCamera()->SetParallelScale(2.2);
  }
};

inline const std::map<std::string, std::string> techniques = {
  { "squares", R"({"default": {"technique": "points", "size": {"mode": "fixed", "px": 3}},
     "shading": {"mode": "edl", "strength": 0.4}})" },
  { "discs", R"({"default": {"technique": "points"}})" },
  { "splats", R"({"default": {"technique": "splats"}})" },
  { "blended", R"({"default": {"technique": "splats", "blended": true}})" },
  { "paraboloids", R"({"default": {"technique": "splats", "orientation": "view"}})" },
  { "fixed", R"({"default": {"technique": "splats", "orientation": [0.1, 0.2, 1]}})" },
  { "spheres", R"({"default": {"technique": "spheres"}})" },
  { "silhouettes", R"({"default": {"technique": "silhouettes"}})" },
  { "facing silhouettes", R"({"default": {"technique": "silhouettes", "orientation": "view",
     "rim_color": "#8020c0"}, "shading": {"mode": "edl"}})" },
  { "exact silhouettes", R"({"default": {"technique": "silhouettes", "accuracy": "exact",
     "size": {"mode": "fixed", "metres": 0.2}}})" },
  { "solid", R"({"default": {"technique": "solid", "wall_color": ["#f0e0d0", "#103060"]}})" },
  { "facing solid", R"({"default": {"technique": "solid", "orientation": "view"}})" },
  { "lit solid", R"({"default": {"technique": "solid", "wall_color": "#a0a0a0"},
     "shading": {"mode": "lit"}})" },
  { "solid class", R"({"default": {"technique": "ewa"}, "classes": {"6": {"technique": "solid",
     "color": "#ff8000"}, "2": {"technique": "silhouettes"}}})" },
  { "ewa", R"({"default": {"technique": "ewa"}})" },
  { "ewa exact", R"({"default": {"technique": "ewa", "accuracy": "exact"}})" },
  { "ewa full", R"({"default": {"technique": "ewa", "accuracy": "full"}})" },
  { "lit", R"({"default": {"technique": "spheres"}, "shading": {"mode": "lit"}})" },
  { "lit ewa", R"({"default": {"technique": "ewa"}, "shading": {"mode": "lit"}})" },
  { "metres", R"({"default": {"technique": "splats", "size": {"mode": "fixed", "metres": 0.1}}})" },
  { "sizes", R"({"default": {"technique": "splats",
     "size": {"mode": "attribute", "attribute": "reach"}}})" },
  { "elevation", R"({"default": {"technique": "splats", "color": "elevation"}})" },
  { "table", R"({"default": {"technique": "ewa", "color": "classification"}})" },
  { "constant", R"({"default": {"technique": "splats", "color": "#4080c0"}})" },
  { "two colours", R"({"default": {"technique": "splats",
     "color": {"multiply": ["rgb", "classification"]}}})" },
  { "classes", R"({"default": {"technique": "ewa"}, "classes": {"6": {"technique": "spheres",
     "color": "#ff8000", "size": {"mode": "spacing", "factor": 1.5}}}})" },
  { "filtered", R"({"default": {"technique": "splats", "where": "reach in [0.015, 0.03]"}})" },
};

} // namespace pointfront::test
