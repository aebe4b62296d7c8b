// A view at rest on OpenGL while its store is being loaded (SMOOTH-5), node by node: each frame
// draws what is new, nothing is drawn twice, no frame has holes, and the complete picture is the
// one that is drawn at one go. The plans are those of SlowView, without a mapper.

#include "OpenGLFunctions.h"
#include "SlowView.h"
#include "Splats.h"
#include "StyleJSON.h"
#include "WindowDrawing.h"

#include "pointfront/Generate/TerrainSource.h"

#include <vtkActor.h>
#include <vtkCullerCollection.h>
#include <vtkObjectFactory.h>
#include <vtkPolyDataMapper.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <unistd.h>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

constexpr int mostFrames = 5000;
constexpr double mostDrawnAgain = 1.1; ///< times the points of the complete picture
/// Share of the complete picture's pixels that each frame covers.
constexpr double leastCovered = 0.96;
/// Share of the pixels that the back ends draw otherwise, in any frame.
constexpr double mostOff = 0.005;

/// Calls a function in VTK's opaque pass.
class CallingMapper : public vtkPolyDataMapper
{
public:
  static CallingMapper* New();
  vtkTypeMacro(CallingMapper, vtkPolyDataMapper);

  std::function<void(vtkRenderer*, vtkActor*)> draw;
  void Render(vtkRenderer* renderer, vtkActor* actor) override { draw(renderer, actor); }
  double* GetBounds() override { return place; }

private:
  double place[6] = { -1.0, 1.0, -1.0, 1.0, -1.0, 1.0 };
};
vtkStandardNewMacro(CallingMapper);

/// A loading view whose plans OpenGL draws in a window of their size.
struct LoadingSplats
{
  LoadingSplats(const std::shared_ptr<const PointStore>& store, const StyleSheet& sheet)
    : view(store, sheet)
    , storePoints(static_cast<std::int64_t>(store->description().pointCount))
  {
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(SlowView::width, SlowView::height);
    window->AddRenderer(renderer);
    actor->SetMapper(mapper);
    renderer->AddActor(actor);
    renderer->GetCullers()->RemoveAllItems();
    renderer->ResetCamera();
    window->Start(); // there is a context before the first frame
    drawing =
      std::make_unique<WindowDrawing>(static_cast<vtkOpenGLRenderWindow*>(window.GetPointer()));
    mapper->draw = [this](vtkRenderer* inRenderer, vtkActor* ofActor)
    { this->draw(inRenderer, ofActor); };
  }
  ~LoadingSplats() { drawing = nullptr; }

  /// Points that GL draws for the frame, in both passes.
  double frame(bool complete = false)
  {
    view.frame(complete); // by software, too
    window->Render();
    return drawn;
  }
  void draw(vtkRenderer* inRenderer, vtkActor* ofActor)
  {
    drawing->enter(inRenderer, ofActor);
    drawing->setStore(this);
    drawing->pool().beginFrame({ 0, 0, 1 });
    drawing->upload(view.plan, std::numeric_limits<std::int64_t>::max());
    GLuint query = 0;
    glGenQueries(1, &query);
    glBeginQuery(GL_PRIMITIVES_GENERATED, query);
    points = drawing->drawSplats(inRenderer, view.plan, false, false);
    glEndQuery(GL_PRIMITIVES_GENERATED);
    GLuint count = 0;
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &count);
    glDeleteQueries(1, &query);
    drawn = count;
    drawing->splats().handOver(inRenderer, ofActor, view.plan, storePoints);
  }
  Picture picture()
  {
    Picture seen;
    seen.width = SlowView::width;
    seen.height = SlowView::height;
    vtkNew<vtkUnsignedCharArray> pixels;
    window->GetPixelData(0, 0, seen.width - 1, seen.height - 1, 0, pixels);
    seen.rgb.assign(pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues());
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    return seen;
  }

  /// Share of the pixels that the software back end draws otherwise.
  double offSoftware()
  {
    const Picture gl = picture();
    Picture software = gl;
    shade(view.plan.camera, view.plan.shading, view.target);
    for (std::size_t pixel = 0; pixel < view.target.rgba.size(); ++pixel)
    {
      std::memcpy(software.rgb.data() + 3 * pixel, &view.target.rgba[pixel], 3);
    }
    return double(differing(gl, software, 2)) / (SlowView::width * SlowView::height);
  }

  SlowView view;
  std::int64_t storePoints;
  std::int64_t points = 0;
  double drawn = 0.0;
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
  vtkNew<CallingMapper> mapper;
  vtkNew<vtkActor> actor;
  std::unique_ptr<WindowDrawing> drawing;
};

struct RefiningSplats
{
  std::string name;
  std::string json;
  double most; ///< points drawn over all frames, times those of the complete picture at one go
  bool asSoftware = true; ///< each frame; else the last one
};
/// A blended point is drawn once, goes through the second pass as it comes, and once more when all
/// is there.
constexpr double mostBlendedAgain = (mostDrawnAgain + 2.15) / 2.0;

const RefiningSplats refiningSplats[] = {
  { "discs", R"({"default": {"technique": "splats"}})", mostDrawnAgain },
  { "ellipses", R"({"default": {"technique": "splats", "orientation": [0.1, 0.2, 1]}})",
    mostDrawnAgain },
  { "spheres", R"({"default": {"technique": "spheres"}, "shading": {"mode": "lit"}})",
    mostDrawnAgain },
  { "blended", R"({"default": {"technique": "splats", "blended": true}})", mostBlendedAgain,
    false },
  { "ewa", R"({"default": {"technique": "ewa", "orientation": [0.1, 0.2, 1]}})", mostBlendedAgain,
    false },
  { "composed", R"({"default": {"technique": "splats"}, "classes": {"5": {"opacity": 0.4},
      "6": {"technique": "ewa"}}, "shading": {"mode": "edl", "fill_holes": true},
      "lenses": [{"shape": "circle", "center_px": [240, 160], "radius_px": 90, "inside":
        {"default": {"technique": "spheres", "color": "classification"}}}],
      "highlight": [{"class": 6, "color": "#ffcc00"}]})",
    mostBlendedAgain, false },
};

std::shared_ptr<const PointStore> townOf(std::size_t points)
{
  const std::string name = "refining-" + std::to_string(getpid());
  static const std::string path =
    builtStore(name, std::make_unique<TerrainSource>(points, 11), nodesOf(2000));
  return openedStore(path);
}

/// Share of the pixels of the complete picture that another one covers.
double coveredOf(const Picture& complete, const Picture& other)
{
  double covered = 0.0, all = 0.0;
  for (std::size_t i = 0; i < complete.rgb.size(); i += 3)
  {
    const auto isLit = [&](const Picture& one)
    { return one.rgb[i] + one.rgb[i + 1] + one.rgb[i + 2] > 0; };
    all += isLit(complete) ? 1.0 : 0.0;
    covered += isLit(complete) && isLit(other) ? 1.0 : 0.0;
  }
  return covered / all;
}

} // namespace

namespace
{

/// The frames of a view until it was complete.
struct SeenFrames
{
  double drawn = 0.0;
  double off = 0.0; ///< offSoftware() of the worst frame
  int frames = 0;
  int gained = 0; ///< frames after the first with more points than the one before
  std::vector<Picture> pictures;
};

SeenFrames refine(LoadingSplats& scene, bool compares)
{
  SeenFrames seen;
  std::int64_t before = 0;
  do
  {
    scene.view.waitForNews();
    seen.drawn += scene.frame();
    seen.gained += seen.frames > 0 && scene.points > before;
    before = scene.points;
    seen.pictures.push_back(scene.picture());
    seen.off = compares ? std::max(seen.off, scene.offSoftware()) : 0.0;
  } while (!scene.view.isComplete() && ++seen.frames < mostFrames);
  EXPECT_TRUE(scene.view.isComplete());
  return seen;
}

/// Refines a view of each style, whose frames are `growthStep` seconds apart.
void expectRefined(const RefiningSplats& style, double growthStep, double most)
{
  const std::shared_ptr<const PointStore> store = townOf(100000);
  const Result<StyleSheet> sheet = parseStyleSheet(style.json);
  ASSERT_TRUE(store && sheet.ok()) << sheet.error().what;
  LoadingSplats atOnce(store, *sheet);
  const double once = atOnce.frame(true); // the table's rows are there then
  const Picture complete = atOnce.picture();
  EXPECT_GT(complete.lit(), 40000) << style.name;

  LoadingSplats scene(store, *sheet);
  scene.view.growthStep = growthStep;
  const SeenFrames seen = refine(scene, style.asSoftware);
  EXPECT_GE(seen.gained, 3) << style.name;
  EXPECT_LE(seen.drawn / once, most) << style.name << ", " << seen.frames << " frames";
  EXPECT_EQ(scene.points, atOnce.points) << style.name;
  EXPECT_EQ(differing(complete, seen.pictures.back()), 0) << style.name;
  EXPECT_LE(seen.off, mostOff) << style.name;
  double least = 1.0;
  for (const Picture& picture : seen.pictures)
  {
    least = std::min(least, coveredOf(complete, picture));
  }
  EXPECT_GE(least, leastCovered) << style.name;
  const std::string name = style.name + (growthStep > 0.0 ? "_growing" : "");
  testing::Test::RecordProperty(name + "_off", std::to_string(seen.off));
  testing::Test::RecordProperty(name + "_drawn", std::to_string(seen.drawn / once));
  testing::Test::RecordProperty(name + "_covered", std::to_string(least));
  testing::Test::RecordProperty(name + "_frames", std::to_string(seen.frames));
}

} // namespace

TEST(Refining, DrawsNothingTwice)
{
  for (const RefiningSplats& style : refiningSplats)
  {
    expectRefined(style, 0.0, style.most);
  }
}

/// As windows show it: what arrives grows (SMOOTH-6), in five frames. What grows is drawn each
/// time; what has grown is not.
TEST(Refining, DrawsWhatHasGrownOnce)
{
  for (const RefiningSplats& style : refiningSplats)
  {
    expectRefined(style, 0.05, 2.5);
  }
}
