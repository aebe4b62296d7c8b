// Points at one place have one depth. Which of them is seen follows from their ids, in both back
// ends and in whatever order nodes come.

#include "LoadingClouds.h"
#include "PlanOfPoints.h"

#include <glm/trigonometric.hpp>

#include <algorithm>
#include <string>
#include <vector>

using namespace pointfront;
using namespace pointfront::test;

namespace
{

/// A window in which OpenGL draws plans, each after the one before.
class PlanWindow
{
public:
  static constexpr int width = 160;
  static constexpr int height = 120;

  PlanWindow()
  {
    window_->SetOffScreenRendering(1);
    window_->SetMultiSamples(0);
    window_->SetSize(width, height);
    window_->AddRenderer(renderer_);
    renderer_->GetCullers()->RemoveAllItems();
    actor_->SetMapper(mapper_);
    mapper_->draw = [this](vtkRenderer* renderer, vtkActor* actor) { this->draw(renderer, actor); };
    renderer_->AddActor(actor_);
    renderer_->ResetCamera();
    window_->Start(); // there is a context before the first frame
    drawing_ =
      std::make_unique<WindowDrawing>(static_cast<vtkOpenGLRenderWindow*>(window_.GetPointer()));
  }
  ~PlanWindow() { drawing_ = nullptr; }
  PlanWindow(const PlanWindow&) = delete;
  PlanWindow& operator=(const PlanWindow&) = delete;

  Picture show(const FramePlan& plan)
  {
    plan_ = plan;
    window_->Render();
    Picture seen;
    seen.width = width;
    seen.height = height;
    vtkNew<vtkUnsignedCharArray> pixels;
    window_->GetPixelData(0, 0, width - 1, height - 1, 0, pixels);
    seen.rgb.assign(pixels->GetPointer(0), pixels->GetPointer(0) + pixels->GetNumberOfValues());
    EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
    return seen;
  }

private:
  void draw(vtkRenderer* renderer, vtkActor* actor)
  {
    drawing_->enter(renderer, actor);
    drawing_->setStore(this);
    drawing_->pool().beginFrame({ 0, 0, 1 });
    drawing_->upload(plan_, std::numeric_limits<std::int64_t>::max());
    drawing_->drawSplats(renderer, plan_, false, false);
    drawing_->splats().handOver(renderer, actor, plan_, 1 << 20);
  }

  FramePlan plan_;
  vtkNew<CallingMapper> mapper_;
  vtkNew<vtkActor> actor_;
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderer> renderer_;
  std::unique_ptr<WindowDrawing> drawing_;
};

/// Four nodes of the same places, from red to blue; of the first one half is there. The second and
/// the last are of another layer, whose style differs by a colour that no point has.
struct SamePlaces : PlanOfPoints
{
  SamePlaces(Technique technique, bool lit, bool layers)
  {
    style->technique = technique;
    style->size = { SplatSize::Mode::World, 0.1, 0 };
    auto other = std::make_shared<ResolvedStyle>(*style);
    other->flat = { 1, 2, 3, 255 };
    plan.shading.lit = lit;
    plan.batches.push_back({ 1, other, {} });
    std::vector<TestPoint> points = wavySurface(400, 5);
    constexpr std::array<std::uint8_t, 3> colours[] = { { 255, 0, 0 }, { 0, 255, 0 },
      { 255, 255, 0 }, { 0, 0, 255 } };
    for (const auto& colour : colours)
    {
      std::vector<TestPoint> some;
      for (TestPoint& point : points)
      {
        point.rgb = colour;
        !nodes.empty() || point.position.x < 0.0 ? some.push_back(point) : void();
      }
      PlanItem item = add(some, 0.05);
      auto node = std::make_shared<NodeColumns>(*item.node);
      node->layer = layers ? nodes.size() % 2 : 0;
      item.node = std::move(node);
      nodes.push_back(std::move(item));
    }
    plan.batches[0].items.clear();
    look({ 0.3, -3.0, 2.0 }, { 0.0, 0.0, 0.0 }, glm::radians(45.0), PlanWindow::width,
      PlanWindow::height);
  }
  /// The plan of some of the nodes; the view refines until all are there.
  FramePlan of(const std::vector<std::size_t>& numbers) const
  {
    FramePlan some = plan;
    for (const std::size_t number : numbers)
    {
      some.batches[nodes[number].node->layer].items.push_back(nodes[number]);
    }
    some.refining = some.keepsVisible = numbers.size() < nodes.size();
    return some;
  }

  std::vector<PlanItem> nodes;
};

/// Share of the pixels that the software back end draws otherwise.
double offSoftware(const SoftwareTarget& software, const Picture& gl)
{
  Picture other = gl;
  for (std::size_t pixel = 0; pixel < software.rgba.size(); ++pixel)
  {
    std::memcpy(other.rgb.data() + 3 * pixel, &software.rgba[pixel], 3);
  }
  return double(differing(gl, other, 2)) / (PlanWindow::width * PlanWindow::height);
}

const std::vector<std::vector<std::size_t>> arrivals[] = {
  { { 3 }, { 2, 3 }, { 1, 2, 3 }, { 0, 1, 2, 3 } },
  { { 1 }, { 1, 3 }, { 0, 1, 2, 3 } },
  { { 0, 3 }, { 0, 1, 2, 3 } },
};

} // namespace

TEST(Ties, AreDecidedByIdsInWhateverOrderNodesCome)
{
  for (const Technique technique : { Technique::Splats, Technique::Spheres, Technique::Points })
  {
    for (const bool lit : { false, true })
    {
      for (const bool layers : { false, true })
      {
        const std::string what = std::to_string(static_cast<int>(technique)) +
          (lit ? ", lit" : "") + (layers ? ", two layers" : "");
        const SamePlaces scene(technique, lit, layers);
        const FramePlan all = scene.of({ 0, 1, 2, 3 });
        SoftwareRasteriser rasteriser;
        SoftwareComposition composition;
        SoftwareTarget software;
        software.reset(PlanWindow::width, PlanWindow::height);
        composition.draw(rasteriser, all, software);
        composition.finish(all.camera, all.shading, software);
        PlanWindow once;
        const Picture complete = once.show(all);
        EXPECT_GT(complete.lit(), 2000) << what;
        EXPECT_LE(offSoftware(software, complete), 0.005) << what;
        for (const auto& frames : arrivals)
        {
          PlanWindow window;
          Picture last;
          for (const std::vector<std::size_t>& numbers : frames)
          {
            last = window.show(scene.of(numbers));
          }
          EXPECT_EQ(differing(complete, last), 0) << what << ", " << frames.size() << " frames";
        }
      }
    }
  }
}
