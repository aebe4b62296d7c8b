#include "ViewWindow.h"

#include "CameraJson.h"
#include "CameraMotion.h"
#include "ClassList.h"
#include "CloudFormats.h"
#include "FrameFacts.h"
#include "FreshName.h"
#include "HandStyle.h"
#include "Inspection.h"
#include "Looks.h"
#include "MappedStores.h"
#include "Redraw.h"
#include "TextPanel.h"
#include "ViewCamera.h"
#include "WholeFile.h"
#include "WindowPicture.h"
#include "XConnection.h"

#include "pointfront/Base/PrintableText.h"

#include "vtkPointFrontMapper.h"

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

namespace pointfront
{

namespace
{
constexpr double stillRate = 0.0001; // frames a second: VTK's value for a view at rest
constexpr std::chrono::milliseconds loadingPause{ 10 }; // between two looks at what has arrived
constexpr std::chrono::milliseconds strandedPause{ 200 }; // where a view is not complete, and rests
constexpr std::chrono::milliseconds rest{ 250 }; // after a single step the camera is at rest

int backendOf(DrawingBackend backend)
{
  switch (backend)
  {
    case DrawingBackend::Software:
      return vtkPointFrontMapper::SOFTWARE;
    case DrawingBackend::OpenGL:
      return vtkPointFrontMapper::OPENGL;
    case DrawingBackend::Auto:
      break;
  }
  return vtkPointFrontMapper::AUTOMATIC;
}

/// The window, put together: what a key does, and when a frame is drawn.
class ViewWindow final : private HandTarget
{
public:
  explicit ViewWindow(const ViewRequest& request)
    : request_(request)
    , looks_(request.drawing)
  {
  }

  Result<void> open();
  /// Until the user ends it.
  void run() { interactor_->Start(); }

private:
  void obey(KeyAction action, const glm::ivec2& pixel) override;
  void click(const glm::ivec2& pixel) override;
  void step() override;

  void look(KeyAction action);
  /// True if the key is about how points are drawn.
  bool restyle(KeyAction action);
  /// The same for the list of classes.
  bool listClasses(KeyAction action);
  void draw(const Looks& looks, const std::string& sentence);
  void inspect(bool measure, const glm::ivec2& pixel);
  /// Text over the upper left corner, in the place of what was there.
  void layOver(const std::string& text);
  Redraw::Pause redraw();
  void takePicture();
  void saveCamera();
  /// Says at the lower edge and on stdout what became of a file.
  void tell(const Result<void>& written, const std::string& file);
  void complain(const std::string& what);

  using Clock = std::chrono::steady_clock;
  const ViewRequest request_;
  XConnection connection_; // outlives the window
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  vtkNew<HandStyle> style_;
  MappedStores stores_;
  ViewCamera camera_{ renderer_, stores_ };
  Camera saved_;
  Looks looks_;
  ClassList classes_;
  bool listed_ = false; ///< the classes lie over the picture
  Inspection inspection_{ renderer_, stores_ };
  TextPanel sheet_{ renderer_, TextPanel::Corner::UpperLeft };
  TextPanel notice_{ renderer_, TextPanel::Corner::LowerLeft };
  Redraw redraw_{ interactor_, [this] { return redraw(); } };
  FrameFacts facts_{ window_, renderer_, stores_, [this] { redraw_.wake(loadingPause); } };
  std::optional<Clock::time_point> restDue_; ///< of a camera that made a single step
  std::string complaint_; ///< the last one
};

Result<void> ViewWindow::open()
{
  const DrawingOptions& drawing = request_.drawing;
  if (Result<void> opened = stores_.open(drawing); !opened)
  {
    return opened;
  }
  for (const std::string& warning : stores_.warnings())
  {
    std::fprintf(stderr, "pointfront view: warning: %s\n", printableText(warning).c_str());
  }
  if (Result<void> connected = connection_.open(
        "a window", "use render, or python3 -m pointfront serve, which draws for a browser");
      !connected)
  {
    return connected;
  }
  renderer_->SetBackground(drawing.background.data());
  window_->SetMultiSamples(0);
  window_->SetSize(drawing.size[0], drawing.size[1]);
  window_->SetWindowName("PointFront");
  window_->SetDesiredUpdateRate(stillRate);
  window_->AddRenderer(renderer_);
  stores_.errors().observe(window_);
  interactor_->SetRenderWindow(window_);
  interactor_->SetInteractorStyle(style_);
  style_->connect(&camera_, this);
  looks_.choose(stores_.clouds());
  if (Result<void> shown = stores_.show(looks_.drawing(), backendOf(drawing.backend), renderer_);
      !shown)
  {
    return shown;
  }
  if (request_.camera)
  {
    camera_.set(*request_.camera);
  }
  else
  {
    camera_.showAll(request_.direction);
  }
  saved_ = camera_.camera();
  notice_.set("? for help");
  interactor_->Initialize();
  window_->Render();
  window_->SetWindowName(("PointFront: " + drawing.stores.front()).c_str()); // it obeys from now on
  return stores_.errors().outcome();
}

Redraw::Pause ViewWindow::redraw()
{
  if (const Result<void> heard = stores_.errors().take(); !heard)
  {
    complain(heard.error().what);
  }
  const bool rests = restDue_ && Clock::now() >= *restDue_;
  if (rests)
  {
    restDue_.reset();
    window_->SetDesiredUpdateRate(stillRate);
  }
  if (rests || stores_.needsRender())
  {
    interactor_->Render();
    return loadingPause;
  }
  if (restDue_ || stores_.loading() != nullptr)
  {
    return loadingPause;
  }
  if (!stores_.record().complete)
  {
    return strandedPause;
  }
  if (facts_.wantsFrame())
  {
    interactor_->Render();
  }
  return {};
}

void ViewWindow::step()
{
  window_->SetDesiredUpdateRate(interactor_->GetDesiredUpdateRate());
  restDue_ = Clock::now() + rest;
  interactor_->Render();
}

void ViewWindow::look(KeyAction action)
{
  switch (action)
  {
    case KeyAction::ShowAll:
      camera_.showAll(request_.direction);
      break;
    case KeyAction::ViewIso:
      camera_.showAll(ViewDirection::Iso);
      break;
    case KeyAction::ViewTop:
      camera_.showAll(ViewDirection::Top);
      break;
    case KeyAction::ViewFront:
      camera_.showAll(ViewDirection::Front);
      break;
    case KeyAction::ViewBack:
      camera_.showAll(ViewDirection::Back);
      break;
    case KeyAction::ViewLeft:
      camera_.showAll(ViewDirection::Left);
      break;
    case KeyAction::ViewRight:
      camera_.showAll(ViewDirection::Right);
      break;
    case KeyAction::Projection:
      camera_.set(otherProjection(camera_.camera()));
      break;
    case KeyAction::RestoreCamera:
      camera_.set(saved_);
      break;
    default:
      break;
  }
}

bool ViewWindow::restyle(KeyAction action)
{
  Looks looks = looks_;
  const std::optional<std::string> sentence = looks.obey(action);
  if (sentence)
  {
    draw(looks, *sentence);
  }
  return sentence.has_value();
}

bool ViewWindow::listClasses(KeyAction action)
{
  if (action == KeyAction::Classes && listed_)
  {
    layOver("");
    return true;
  }
  if (action == KeyAction::Classes)
  {
    Result<ClassList> classes = ClassList::of(stores_.clouds(), looks_.drawing().classes);
    if (!classes)
    {
      complain(classes.error().what);
      return true;
    }
    classes_ = std::move(*classes);
  }
  else if (action == KeyAction::Up || action == KeyAction::Down)
  {
    classes_.move(action == KeyAction::Up ? -1 : 1);
  }
  else if (action == KeyAction::Toggle && listed_)
  {
    Looks looks = looks_;
    classes_.toggle();
    looks.showClasses(classes_.shown());
    draw(looks, "");
  }
  else
  {
    return false;
  }
  if (action == KeyAction::Classes || listed_)
  {
    layOver(classes_.empty() ? "no point has a class" : classes_.text());
    listed_ = true;
  }
  return true;
}

void ViewWindow::draw(const Looks& looks, const std::string& sentence)
{
  const int backend = backendOf(request_.drawing.backend);
  if (Result<void> shown = stores_.show(looks.drawing(), backend, renderer_); !shown)
  {
    complain(shown.error().what);
    return;
  }
  looks_ = looks;
  notice_.set(sentence);
}

void ViewWindow::inspect(bool measure, const glm::ivec2& pixel)
{
  const Result<std::string> text = measure ? inspection_.measure(pixel) : inspection_.pick(pixel);
  if (!text)
  {
    complain(text.error().what);
    return;
  }
  layOver(*text);
}

void ViewWindow::click(const glm::ivec2& pixel)
{
  notice_.set("");
  inspect(inspection_.measuring(), pixel);
  interactor_->Render();
}

void ViewWindow::layOver(const std::string& text)
{
  listed_ = false;
  sheet_.set(text);
}

void ViewWindow::obey(KeyAction action, const glm::ivec2& pixel)
{
  notice_.set("");
  switch (action)
  {
    case KeyAction::Quit:
      interactor_->TerminateApp();
      return;
    case KeyAction::Help:
      layOver(sheet_.text() == keyHelp() ? "" : keyHelp());
      break;
    case KeyAction::Escape:
      layOver("");
      inspection_.clear();
      break;
    case KeyAction::Facts:
      facts_.toggle();
      break;
    case KeyAction::Pick:
    case KeyAction::Measure:
      inspect(action == KeyAction::Measure, pixel);
      break;
    case KeyAction::Screenshot:
      takePicture();
      break;
    case KeyAction::SaveCamera:
      saveCamera();
      break;
    default:
      if (!restyle(action) && !listClasses(action))
      {
        look(action);
      }
  }
  interactor_->Render();
}

void ViewWindow::takePicture()
{
  for (TextPanel* const panel : { &sheet_, &notice_, &facts_.panel() })
  {
    panel->setVisible(false);
  }
  stores_.draw(window_, true);
  const std::string file = freshName("pointfront", ".png");
  tell(writeWindowPicture(window_, file), file);
  for (TextPanel* const panel : { &sheet_, &notice_, &facts_.panel() })
  {
    panel->setVisible(true);
  }
  stores_.draw(window_, false);
}

void ViewWindow::saveCamera()
{
  saved_ = camera_.camera();
  const std::string file = freshName("pointfront-camera", ".json");
  tell(writeWholeFile(file, jsonOf(saved_).dump() + "\n"), file);
}

void ViewWindow::tell(const Result<void>& written, const std::string& file)
{
  if (!written)
  {
    complain(written.error().what);
    return;
  }
  std::printf("%s\n", file.c_str());
  std::fflush(stdout);
  notice_.set(file);
}

void ViewWindow::complain(const std::string& what)
{
  if (what != complaint_)
  {
    std::fprintf(stderr, "pointfront view: %s\n", printableText(what).c_str());
  }
  complaint_ = what;
  notice_.set(what);
}

} // namespace

void pointfrontShowWindow(const ViewRequest& request, Result<void>& outcome)
{
  // Where the kernel is a static library this module has a kernel of its own.
  addCloudFormats();
  ViewWindow window(request);
  outcome = window.open();
  if (outcome)
  {
    window.run();
  }
}

} // namespace pointfront
