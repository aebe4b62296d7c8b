#include "Scene.h"
#include "vtkPointFrontStyle.h"

#include <vtkCellArray.h>
#include <vtkHardwareSelector.h>
#include <vtkIdTypeArray.h>
#include <vtkInformation.h>
#include <vtkMapper.h>
#include <vtkPointData.h>
#include <vtkPoints.h>

#include <algorithm>
#include <cmath>
#include <utility>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

/// A sheet of 150 * 150 points, 20 mm apart, seen obliquely, whose colours are their numbers.
struct NumberedSheet : Scene
{
  NumberedSheet()
    : Scene(store())
  {
    lookFrom({ 3.0, -6.0, 4.0 }, { 0.0, 0.0, 0.0 });
    mapper->SetPointSize(2.0);
    reader->SetOverviewPoints(1000000);
    reader->Update();
    all->ShallowCopy(reader->GetOutput());
    reader->SetOverviewPoints(1000);
  }
  static std::string store()
  {
    return storeOf("numbered", 150 * 150,
      [](std::size_t i)
      {
        const int column = static_cast<int>(i % 150);
        const int row = static_cast<int>(i / 150);
        Sample sample;
        sample.position = { 20 * column - 1490, 20 * row - 1490,
          static_cast<int>(300.0 * std::sin(0.07 * column) * std::cos(0.05 * row)) };
        const std::size_t number = i + 1;
        sample.rgb = { static_cast<std::uint8_t>(number & 255),
          static_cast<std::uint8_t>(number >> 8), static_cast<std::uint8_t>(200) };
        return sample;
      });
  }
  /// Number of the point that each pixel shows, by its colour; 0: another actor's, or none.
  std::vector<int> shown()
  {
    const Picture picture = draw();
    std::vector<int> numbers;
    for (std::size_t i = 0; i < picture.rgb.size(); i += 3)
    {
      const bool point = picture.rgb[i + 2] == 200;
      numbers.push_back(point ? picture.rgb[i] + 256 * picture.rgb[i + 1] : 0);
    }
    return numbers;
  }
  /// Number of the point that a selection finds in each pixel.
  std::vector<int> selected()
  {
    auto* ids = vtkIdTypeArray::SafeDownCast(all->GetPointData()->GetGlobalIds());
    vtkDataArray* colours = all->GetPointData()->GetArray("rgb");
    const int* size = window->GetSize();
    vtkNew<vtkHardwareSelector> selector;
    selector->SetRenderer(renderer);
    selector->SetArea(0, 0, static_cast<unsigned>(size[0] - 1), static_cast<unsigned>(size[1] - 1));
    selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_POINTS);
    EXPECT_TRUE(selector->CaptureBuffers());
    std::vector<int> numbers;
    for (unsigned y = 0; y < static_cast<unsigned>(size[1]); ++y)
    {
      for (unsigned x = 0; x < static_cast<unsigned>(size[0]); ++x)
      {
        const unsigned pixel[2] = { x, y };
        const auto found = selector->GetPixelInformation(pixel);
        if (!found.Valid || found.Prop != actor)
        {
          numbers.push_back(0);
          continue;
        }
        const double* rgb = colours->GetTuple3(ids->LookupValue(found.AttributeID));
        numbers.push_back(static_cast<int>(rgb[0]) + 256 * static_cast<int>(rgb[1]));
      }
    }
    return numbers;
  }
  /// The same point in every pixel.
  void expectWhatIsShown(const char* what)
  {
    const std::vector<int> expected = shown();
    expect(expected, what);
  }
  void expect(const std::vector<int>& expected, const char* what)
  {
    const std::vector<int> found = selected();
    ASSERT_EQ(found.size(), expected.size());
    const auto lit = expected.size() - std::count(expected.begin(), expected.end(), 0);
    EXPECT_GT(lit, 5000) << what;
    int differ = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      differ += found[i] != expected[i] ? 1 : 0;
    }
    EXPECT_EQ(differ, 0) << what << ", of " << lit << " pixels";
  }

  vtkNew<vtkPolyData> all; ///< the points with their ids as global ids
};

TEST(Selection, FindsThePointOfEachPixel)
{
  for (const int backend : { vtkPointFrontMapper::OPENGL, vtkPointFrontMapper::SOFTWARE })
  {
    NumberedSheet scene;
    scene.mapper->SetBackend(backend);
    for (const double sizePx : { 1.0, 2.0, 3.0, 5.0 })
    {
      scene.mapper->SetPointSize(sizePx);
      const std::string what = "back end " + std::to_string(backend) + ", size " +
        std::to_string(static_cast<int>(sizePx));
      scene.expectWhatIsShown(what.c_str());
    }
    // Squares reach into the view from beside.
    scene.lookFrom({ 0.3, -1.5, 1.6 }, { 0.0, 0.0, 0.0 });
    scene.mapper->SetPointSize(20.0);
    scene.expectWhatIsShown(("back end " + std::to_string(backend) + ", border").c_str());
  }
}

TEST(Selection, TakesTheSizeOfTheProperty)
{
  NumberedSheet scene;
  scene.mapper->SetPointSize(0.0);
  scene.actor->GetProperty()->SetPointSize(4.0f);
  scene.expectWhatIsShown("4 pixels");
}

TEST(Selection, FindsNothingBehindOthers)
{
  NumberedSheet scene;
  vtkNew<vtkPoints> corners; // a wall that stands in the sheet
  for (const glm::dvec2& corner :
    { glm::dvec2(-0.8, -0.5), { 0.8, -0.5 }, { 0.8, 0.5 }, { -0.8, 0.5 } })
  {
    corners->InsertNextPoint(corner.x, 0.0, corner.y);
  }
  vtkNew<vtkCellArray> quad;
  quad->InsertNextCell({ 0, 1, 2, 3 });
  vtkNew<vtkPolyData> surface;
  surface->SetPoints(corners);
  surface->SetPolys(quad);
  vtkNew<vtkPolyDataMapper> wallMapper;
  wallMapper->SetInputData(surface);
  vtkNew<vtkActor> wall;
  wall->SetMapper(wallMapper);
  wall->GetProperty()->SetColor(1.0, 0.0, 0.0);
  wall->PickableOff(); // it hides; VTK would find its corners too, as points of six pixels
  scene.renderer->RemoveActor(scene.actor);
  scene.renderer->AddActor(wall);
  scene.renderer->AddActor(scene.actor); // the last: it wins where both have one depth
  // So far that 1/65000 of the range of depths is more than the sheet.
  scene.lookFrom({ 300.0, -600.0, 400.0 }, { 0.0, 0.0, 0.0 });
  scene.renderer->GetActiveCamera()->SetViewAngle(0.3);
  scene.renderer->GetActiveCamera()->SetClippingRange(100.0, 2000.0);
  scene.expectWhatIsShown("a wall in the sheet");
}

TEST(Selection, FindsTheNearestWhereALayerAboveClearsDepths)
{
  for (const int backend : { vtkPointFrontMapper::OPENGL, vtkPointFrontMapper::SOFTWARE })
  {
    NumberedSheet scene;
    scene.mapper->SetBackend(backend);
    vtkNew<vtkRenderer> corner; // as ParaView's orientation axes
    corner->SetViewport(0.0, 0.0, 0.5, 0.5);
    corner->SetLayer(1);
    corner->InteractiveOff();
    scene.window->SetNumberOfLayers(2);
    scene.window->AddRenderer(corner);
    const std::vector<int> expected = scene.shown();
    vtkNew<vtkPointFrontMapper> behind; // drawn after it
    behind->SetBackend(backend);
    behind->SetPointSize(2.0);
    behind->SetInputConnection(scene.reader->GetOutputPort());
    vtkNew<vtkActor> second;
    second->SetMapper(behind);
    second->SetPosition(0.0, 0.0, -0.5);
    scene.renderer->AddActor(second);
    scene.draw();
    const std::vector<int> found = scene.selected();
    int lost = 0;
    for (std::size_t i = 0; i < found.size(); ++i)
    {
      lost += expected[i] != 0 && found[i] != expected[i] ? 1 : 0;
    }
    EXPECT_EQ(lost, 0) << "back end " << backend;
  }
}

/// A halo is decoration: a pixel that shows nothing else is nobody's.
TEST(Selection, FindsNothingInAHalo)
{
  for (const int backend : { vtkPointFrontMapper::OPENGL, vtkPointFrontMapper::SOFTWARE })
  {
    NumberedSheet scene;
    scene.mapper->SetBackend(backend);
    vtkNew<vtkPointFrontStyle> style;
    scene.mapper->SetStyle(style);
    const std::string points =
      R"({"default": {"color": "rgb", "size": {"mode": "fixed", "px": 2}})";
    ASSERT_TRUE(style->LoadJSON(points + "}"));
    const std::vector<int> shown = scene.shown();
    const std::string halo =
      points + R"(, "highlight": [{"class": 0, "color": "#00ff00", "halo_px": 10, "tint": 0}]})";
    ASSERT_TRUE(style->LoadJSON(halo));
    const Picture picture = scene.draw();
    int rim = 0;
    for (std::size_t i = 0; i < shown.size(); ++i)
    {
      rim += shown[i] == 0 && picture.rgb[3 * i + 1] == 255 ? 1 : 0;
    }
    EXPECT_GT(rim, 3000) << "back end " << backend;
    const std::string what = "a halo, back end " + std::to_string(backend);
    scene.expect(shown, what.c_str());
    scene.draw();
    vtkNew<vtkHardwareSelector> selector;
    selector->SetRenderer(scene.renderer);
    selector->SetFieldAssociation(vtkDataObject::FIELD_ASSOCIATION_CELLS);
    selector->SetArea(0, 0, 299, 199);
    ASSERT_TRUE(selector->CaptureBuffers());
    int props = 0;
    for (unsigned i = 0; i < shown.size(); ++i)
    {
      const unsigned pixel[2] = { i % 300, i / 300 };
      props += selector->GetPixelInformation(pixel).Prop == scene.actor.Get() && shown[i] == 0;
    }
    EXPECT_EQ(props, 0) << what;
  }
}

TEST(Selection, IsThatOfTheCoincidentOffset)
{
  const int before = vtkMapper::GetResolveCoincidentTopology();
  vtkMapper::SetResolveCoincidentTopologyToPolygonOffset();
  NumberedSheet scene;
  scene.mapper->SetRelativeCoincidentTopologyPointOffsetParameter(-3.0);
  scene.expectWhatIsShown("moved towards the eye");
  vtkMapper::SetResolveCoincidentTopology(before);
}

TEST(Selection, IsOfPixelsInAMultisampledWindow)
{
  NumberedSheet scene;
  const std::vector<int> expected = scene.shown();
  scene.window->SetMultiSamples(4);
  scene.expect(expected, "multisampled");
}

TEST(Selection, FindsTheSpheresThatAreShown)
{
  NumberedSheet scene;
  scene.mapper->SetPointSize(9.0);
  scene.actor->GetProperty()->RenderPointsAsSpheresOn();
  scene.renderer->SetBackground(0.0, 0.0, 1.0); // no sphere is: their rims are black
  const Picture picture = scene.draw();
  const std::vector<int> found = scene.selected();
  int differ = 0;
  for (std::size_t i = 0; i < found.size(); ++i)
  {
    const unsigned char* rgb = &picture.rgb[3 * i];
    const bool shown = rgb[0] > 0 || rgb[1] > 0 || rgb[2] < 255;
    differ += shown != (found[i] != 0) ? 1 : 0;
  }
  EXPECT_EQ(differ, 0);
}

} // namespace
