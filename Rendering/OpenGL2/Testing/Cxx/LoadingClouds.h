#pragma once

#include "OpenGLFunctions.h"
#include "Scene.h"
#include "SlowView.h"
#include "SoftwareComposition.h"
#include "WindowDrawing.h"

#include <vtkActor.h>
#include <vtkCullerCollection.h>
#include <vtkObjectFactory.h>
#include <vtkPolyDataMapper.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <vector>

namespace pointfront::test
{

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
inline vtkStandardNewMacro(CallingMapper);

/// Points that the frames of a view drew.
struct LoadingCounts
{
  double points = 0.0; ///< points of the plans
  double drawn = 0.0; ///< points that were not there yet, stand-ins and kept points
  double blended = 0.0; ///< through the second pass
  double onGl = 0.0; ///< that GL drew, in both passes
};

/// Clouds of one view that load side by side, whose plans both back ends draw: the software back
/// end into one picture, as the tool does, OpenGL in a window of that size with an actor each.
/// Threads  the one that made it.
class LoadingClouds
{
public:
  LoadingClouds(
    const std::vector<std::shared_ptr<const PointStore>>& stores, const StyleSheet& sheet)
  {
    window->SetOffScreenRendering(1);
    window->SetMultiSamples(0);
    window->SetSize(SlowView::width, SlowView::height);
    window->AddRenderer(renderer);
    renderer->GetCullers()->RemoveAllItems();
    for (const std::shared_ptr<const PointStore>& store : stores)
    {
      clouds_.push_back(std::make_unique<Cloud>(store, sheet));
      Cloud& cloud = *clouds_.back();
      cloud.view.composited = stores.size() > 1;
      cloud.actor->SetMapper(cloud.mapper);
      cloud.mapper->draw = [this, &cloud](vtkRenderer* inRenderer, vtkActor* ofActor)
      { this->draw(cloud, inRenderer, ofActor); };
      renderer->AddActor(cloud.actor);
    }
    setCamera(clouds_.front()->view.camera);
    renderer->ResetCamera();
    window->Start(); // there is a context before the first frame
    for (const auto& cloud : clouds_)
    {
      cloud->drawing =
        std::make_unique<WindowDrawing>(static_cast<vtkOpenGLRenderWindow*>(window.GetPointer()));
    }
  }
  ~LoadingClouds()
  {
    for (const auto& cloud : clouds_)
    {
      cloud->drawing = nullptr;
    }
  }
  LoadingClouds(const LoadingClouds&) = delete;
  LoadingClouds& operator=(const LoadingClouds&) = delete;

  std::size_t size() const { return clouds_.size(); }
  SlowView& view(std::size_t number = 0) { return clouds_[number]->view; }
  void setCamera(const FrameCamera& camera)
  {
    for (const auto& cloud : clouds_)
    {
      cloud->view.camera = camera;
    }
  }

  LoadingCounts frame(bool complete = false)
  {
    counts_ = {};
    software.keepDecided = clouds_.size() > 1;
    software.reset(SlowView::width, SlowView::height);
    for (std::size_t number = 0; number < clouds_.size(); ++number)
    {
      SlowView& each = clouds_[number]->view;
      each.planNext(complete);
      const RasterStatistics one =
        composition_.draw(rasteriser_, each.plan, software, static_cast<std::uint16_t>(number));
      counts_.points += double(one.points);
      counts_.drawn += double(one.drawn);
      counts_.blended += double(one.blended);
    }
    const FramePlan& plan = clouds_.front()->view.plan;
    composition_.finish(plan.camera, plan.shading, software);
    window->Render();
    return counts_;
  }
  bool isComplete() const
  {
    return std::all_of(
      clouds_.begin(), clouds_.end(), [](const auto& cloud) { return cloud->view.isComplete(); });
  }
  void waitForNews()
  {
    for (const auto& cloud : clouds_)
    {
      cloud->view.isComplete() ? void() : cloud->view.waitForNews();
    }
  }

  /// The picture of OpenGL.
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
    Picture other = gl;
    for (std::size_t pixel = 0; pixel < software.rgba.size(); ++pixel)
    {
      std::memcpy(other.rgb.data() + 3 * pixel, &software.rgba[pixel], 3);
    }
    return double(differing(gl, other, 2)) / (SlowView::width * SlowView::height);
  }

  SoftwareTarget software; ///< the picture of the software back end
  std::int64_t pointsOnGl = 0; ///< points of the last frame's plans

private:
  struct Cloud
  {
    Cloud(const std::shared_ptr<const PointStore>& store, const StyleSheet& sheet)
      : view(store, sheet)
      , storePoints(static_cast<std::int64_t>(store->description().pointCount))
    {
    }
    SlowView view;
    std::int64_t storePoints;
    vtkNew<CallingMapper> mapper;
    vtkNew<vtkActor> actor;
    std::unique_ptr<WindowDrawing> drawing;
  };

  void draw(Cloud& cloud, vtkRenderer* inRenderer, vtkActor* ofActor)
  {
    WindowDrawing& drawing = *cloud.drawing;
    drawing.enter(inRenderer, ofActor);
    drawing.setStore(&cloud);
    drawing.pool().beginFrame({ 0, 0, 1 });
    drawing.upload(cloud.view.plan, std::numeric_limits<std::int64_t>::max());
    GLuint query = 0;
    glGenQueries(1, &query);
    glBeginQuery(GL_PRIMITIVES_GENERATED, query);
    const std::int64_t points = drawing.drawSplats(inRenderer, cloud.view.plan, false, false);
    glEndQuery(GL_PRIMITIVES_GENERATED);
    GLuint count = 0;
    glGetQueryObjectuiv(query, GL_QUERY_RESULT, &count);
    glDeleteQueries(1, &query);
    pointsOnGl = &cloud == clouds_.front().get() ? points : pointsOnGl + points;
    counts_.onGl += count;
    drawing.splats().handOver(inRenderer, ofActor, cloud.view.plan, cloud.storePoints);
  }

  std::vector<std::unique_ptr<Cloud>> clouds_;
  SoftwareRasteriser rasteriser_;
  SoftwareComposition composition_;
  LoadingCounts counts_;
  vtkNew<vtkRenderWindow> window;
  vtkNew<vtkRenderer> renderer;
};

} // namespace pointfront::test
