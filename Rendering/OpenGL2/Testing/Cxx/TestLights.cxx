// Deferred light from VTK's lights, by both back ends.

#include "Scene.h"

#include "vtkPointFrontStyle.h"

#include <vtkCommand.h>
#include <vtkLight.h>
#include <vtkSphereSource.h>
#include <vtkTransform.h>

#include <cmath>
#include <string>
#include <utility>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

using Colour = std::array<int, 3>;
const std::array<int, 2> lightBackends = { vtkPointFrontMapper::SOFTWARE,
  vtkPointFrontMapper::OPENGL };

/// One white sphere that fills much of the view, seen along -z.
struct LitSphere : Scene
{
  vtkNew<vtkPointFrontStyle> style;

  LitSphere()
    : Scene(storeOf("lit-sphere", 1,
        [](std::size_t)
        {
          Sample sample;
          sample.rgb = { 200, 200, 200 };
          return sample;
        }))
  {
    EXPECT_TRUE(style->LoadJSON(
      R"({"default": {"technique": "spheres", "size": {"mode": "fixed", "metres": 2}},
          "shading": {"mode": "lit"}})"));
    mapper->SetStyle(style);
    lookFrom({ 0, 0, 10 }, { 0, 0, 0 });
  }
  vtkSmartPointer<vtkLight> add(
    const std::array<double, 3>& from, const std::array<double, 3>& colour, double intensity = 1.0)
  {
    vtkNew<vtkLight> light;
    light->SetLightTypeToSceneLight();
    light->SetPosition(from[0], from[1], from[2]);
    light->SetFocalPoint(0.0, 0.0, 0.0);
    light->SetDiffuseColor(colour[0], colour[1], colour[2]);
    light->SetIntensity(intensity);
    renderer->AutomaticLightCreationOff();
    renderer->AddLight(light);
    return light.Get();
  }
  Picture by(int backend)
  {
    mapper->SetBackend(backend);
    return draw();
  }
};

void expectNear(const Colour& colour, double red, double green, double blue)
{
  EXPECT_NEAR(colour[0], red, 2.0);
  EXPECT_NEAR(colour[1], green, 2.0);
  EXPECT_NEAR(colour[2], blue, 2.0);
}

/// Half of them of one colour, half of the other; together as bright as one white light is in red.
void addYellowAndMagenta(LitSphere& scene, int count)
{
  for (int i = 0; i < count; ++i)
  {
    const bool yellow = i < count / 2;
    scene.add({ 0, 0, 5 }, { 1.0, yellow ? 1.0 : 0.0, yellow ? 0.0 : 1.0 }, 1.0 / count);
  }
}

/// LitSphere's sphere, as VTK draws it.
vtkSmartPointer<vtkActor> ballOfTriangles()
{
  vtkNew<vtkSphereSource> ball;
  ball->SetRadius(1.0);
  ball->SetThetaResolution(400);
  ball->SetPhiResolution(400);
  vtkNew<vtkPolyDataMapper> triangles;
  triangles->SetInputConnection(ball->GetOutputPort());
  vtkNew<vtkActor> own;
  own->SetMapper(triangles);
  own->GetProperty()->SetColor(200.0 / 255.0, 200.0 / 255.0, 200.0 / 255.0);
  own->GetProperty()->SetAmbient(0.3);
  own->GetProperty()->SetDiffuse(0.7);
  return own.Get();
}

constexpr int middleX = 150;
constexpr int middleY = 100;
constexpr double ambient = 0.3 * 200.0;
constexpr double diffuse = 0.7 * 200.0;

} // namespace

/// Without any the renderer makes one at the camera, as for other mappers.
TEST(Lights, TheRenderersOwnIsAtTheEye)
{
  LitSphere scene;
  for (const int backend : lightBackends)
  {
    expectNear(scene.by(backend).at(middleX, middleY), 200, 200, 200);
  }
}

TEST(Lights, HaveDirectionColourAndIntensity)
{
  LitSphere scene;
  scene.add({ -5, 0, 0 }, { 1, 0, 0 });
  scene.add({ 0, 5, 5 }, { 0, 0, 1 }, 0.5);
  for (const int backend : lightBackends)
  {
    const Picture picture = scene.by(backend);
    const double slanted = 0.5 * diffuse * std::sqrt(0.5);
    expectNear(picture.at(middleX, middleY), ambient, ambient, ambient + slanted);
    EXPECT_GT(picture.at(middleX - 30, middleY)[0], ambient + 0.5 * diffuse);
    EXPECT_NEAR(picture.at(middleX + 30, middleY)[0], ambient, 2.0);
  }
}

/// A light that follows the camera stays where it is on screen, one of the scene does not.
TEST(Lights, FollowTheCameraOrNot)
{
  for (const bool follows : { true, false })
  {
    LitSphere scene;
    vtkLight* const light = scene.add({ 0, 0, 1 }, { 1, 1, 1 });
    follows ? light->SetLightTypeToCameraLight() : light->SetLightTypeToSceneLight();
    scene.lookFrom({ -10, 0, 0 }, { 0, 0, 0 });
    for (const int backend : lightBackends)
    {
      const double expected = follows ? ambient + diffuse : ambient;
      expectNear(scene.by(backend).at(middleX, middleY), expected, expected, expected);
    }
  }
}

/// The view is at rest; nothing but a light has changed.
TEST(Lights, AChangeShowsInTheNextFrame)
{
  LitSphere scene;
  vtkLight* const light = scene.add({ 0, 0, 5 }, { 1, 1, 1 });
  for (const int backend : lightBackends)
  {
    light->SwitchOn();
    light->SetPosition(0, 0, 5);
    expectNear(scene.by(backend).at(middleX, middleY), 200, 200, 200);
    light->SetPosition(0, 5, 5);
    const double slanted = ambient + diffuse * std::sqrt(0.5);
    expectNear(scene.draw().at(middleX, middleY), slanted, slanted, slanted);
    light->SwitchOff();
    expectNear(scene.draw().at(middleX, middleY), ambient, ambient, ambient);
  }
}

TEST(Lights, EachOfManyCounts)
{
  LitSphere scene;
  addYellowAndMagenta(scene, 40);
  for (const int backend : lightBackends)
  {
    expectNear(scene.by(backend).at(middleX, middleY), ambient + diffuse, ambient + 0.5 * diffuse,
      ambient + 0.5 * diffuse);
  }
}

/// OpenGL takes 48 lights: the software back end draws a frame with more, and says so once.
TEST(Lights, MoreThanOpenGLTakesShineAllTheSame)
{
  LitSphere scene;
  addYellowAndMagenta(scene, 60);
  int warnings = 0;
  countEvents(scene.mapper, vtkCommand::WarningEvent, warnings);
  for (int frame = 0; frame < 2; ++frame)
  {
    expectNear(scene.by(vtkPointFrontMapper::OPENGL).at(middleX, middleY), ambient + diffuse,
      ambient + 0.5 * diffuse, ambient + 0.5 * diffuse);
  }
  EXPECT_EQ(warnings, 1);
}

/// OpenGL takes 32 looks: the software back end draws a frame with more, and says so once.
TEST(Lights, MoreLooksThanOpenGLTakesAreDrawnAllTheSame)
{
  LitSphere scene;
  addYellowAndMagenta(scene, 1);
  const Picture few = scene.by(vtkPointFrontMapper::SOFTWARE);
  for (int code = 100; code < 140; ++code)
  {
    scene.style->SetAmbient(0.01 * code, code);
  }
  int warnings = 0;
  countEvents(scene.mapper, vtkCommand::WarningEvent, warnings);
  for (int frame = 0; frame < 2; ++frame)
  {
    EXPECT_EQ(differing(scene.by(vtkPointFrontMapper::OPENGL), few, 0), 0);
  }
  EXPECT_EQ(warnings, 1);
}

/// Only OpenGL draws a translucent actor.
TEST(Lights, BeyondWhatOpenGLTakesAreToldOf)
{
  LitSphere scene;
  addYellowAndMagenta(scene, 60);
  scene.actor->GetProperty()->SetOpacity(0.9);
  int warnings = 0;
  countEvents(scene.mapper, vtkCommand::WarningEvent, warnings);
  scene.by(vtkPointFrontMapper::OPENGL);
  scene.draw();
  EXPECT_EQ(warnings, 1);
}

/// A surface that is turned away from such a lamp is not lit, whatever its numbers say.
TEST(Lights, ThatNothingWeakensAreNoNumbersBeyondFloats)
{
  LitSphere scene;
  vtkLight* const light = scene.add({ 5, 0, 0 }, { 1.0, 1.0, 1.0 });
  light->PositionalOn();
  light->SetConeAngle(120.0);
  light->SetAttenuationValues(0.0, 0.0, 0.0);
  const Picture software = scene.by(vtkPointFrontMapper::SOFTWARE);
  const double dark = software.at(middleX - 20, middleY)[0];
  EXPECT_NEAR(dark, ambient, 2.0);
  EXPECT_EQ(software.at(middleX + 20, middleY)[0], 255);
  EXPECT_LE(differing(software, scene.by(vtkPointFrontMapper::OPENGL), 2), 60);
}

/// A sphere of triangles says how VTK lights what has a place, a cone and a distance.
TEST(Lights, WithAPlaceShineAsOnVTKsOwnSurfaces)
{
  struct Lamp
  {
    std::array<double, 3> from;
    double cone;
    double exponent;
    std::array<double, 3> attenuation;
    int type;
  };
  const Lamp lamps[] = { { { 1.5, 1.0, 2.5 }, 120.0, 1.0, { 1, 0, 0 }, VTK_LIGHT_TYPE_SCENE_LIGHT },
    { { 1.5, 1.0, 2.5 }, 12.0, 1.0, { 1, 0, 0 }, VTK_LIGHT_TYPE_SCENE_LIGHT },
    { { -1.0, 2.0, 3.0 }, 40.0, 20.0, { 0.5, 0.1, 0.05 }, VTK_LIGHT_TYPE_SCENE_LIGHT },
    { { 0.2, 0.3, 0.6 }, 8.0, 4.0, { 1, 0, 0 }, VTK_LIGHT_TYPE_CAMERA_LIGHT } };
  LitSphere scene;
  const auto own = ballOfTriangles();
  scene.renderer->AddActor(own);
  vtkLight* const light = scene.add({ 0, 0, 5 }, { 1.0, 0.8, 0.4 });
  light->PositionalOn();
  vtkNew<vtkTransform> aside; // the scene lies beside the middle of the view
  aside->Translate(0.5, 0.2, 0.0);
  const std::pair<bool, vtkTransform*> views[] = { { false, nullptr }, { true, nullptr },
    { false, aside } };
  for (const auto& [parallel, transform] : views)
  {
    scene.renderer->GetActiveCamera()->SetUserViewTransform(transform);
    scene.renderer->GetActiveCamera()->SetParallelProjection(parallel ? 1 : 0);
    scene.renderer->GetActiveCamera()->SetParallelScale(1.6);
    for (const Lamp& lamp : lamps)
    {
      light->SetLightType(lamp.type);
      light->SetPosition(lamp.from.data());
      light->SetFocalPoint(0.1, 0.2, 0.0);
      light->SetConeAngle(lamp.cone);
      light->SetExponent(lamp.exponent);
      light->SetAttenuationValues(lamp.attenuation.data());
      scene.actor->VisibilityOff();
      own->VisibilityOn();
      const Picture expected = scene.draw();
      scene.actor->VisibilityOn();
      own->VisibilityOff();
      for (const int backend : lightBackends)
      {
        const Picture picture = scene.by(backend);
        EXPECT_GT(picture.lit(), 4000);
        // The rim of a cone and of the sphere may lie a pixel beside.
        EXPECT_LE(differing(picture, expected, 4), 0.04 * picture.lit())
          << lamp.cone << " degrees, " << parallel << ", back end " << backend;
      }
      scene.actor->VisibilityOn();
    }
  }
}

TEST(Lights, WithAPlaceShineOnBothEyes)
{
  LitSphere scene;
  vtkLight* const light = scene.add({ 1.5, 1.0, 2.5 }, { 1, 1, 1 });
  light->PositionalOn();
  light->SetConeAngle(15.0);
  scene.window->SetStereoTypeToAnaglyph();
  scene.window->StereoRenderOn();
  const Picture software = scene.by(vtkPointFrontMapper::SOFTWARE);
  EXPECT_LE(differing(software, scene.by(vtkPointFrontMapper::OPENGL), 2), 0.005 * 300 * 200);
}
