#include "ViewWindow.h"

#include "Appearance.h"
#include "CameraJson.h"
#include "CloudFormats.h"
#include "FrameFacts.h"
#include "FreshName.h"
#include "HandStyle.h"
#include "Inspection.h"
#include "MappedStores.h"
#include "Redraw.h"
#include "ShownFiles.h"
#include "TextPanel.h"
#include "Travel.h"
#include "ViewCamera.h"
#include "WholeFile.h"
#include "WindowPicture.h"
#include "XConnection.h"

#include "pointfront/Base/PrintableText.h"

#include <vtkNew.h>
#include <vtkRenderer.h>
#include <vtkRenderWindow.h>
#include <vtkRenderWindowInteractor.h>

#include <chrono>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace pointfront
{

namespace
{
constexpr std::chrono::milliseconds loadingPause{ 10 }; // between two looks at what has arrived
constexpr std::chrono::milliseconds watchingPause{ 250 }; // between two looks at files that grow
constexpr std::chrono::milliseconds strandedPause{ 200 }; // where a view is not complete, and rests

/// The window, put together: what a key does, and when a frame is drawn.
class ViewWindow final : private HandTarget
{
public:
  explicit ViewWindow(const ViewRequest& request)
    : request_(request)
  {
  }

  Result<void> open();
  /// Until the user ends it.
  void run() { interactor_->Start(); }

private:
  void obey(KeyAction action, const glm::ivec2& pixel) override;
  void click(const glm::ivec2& pixel) override;
  void step() override;
  bool hold(const char* keysym, bool down) override;
  void letGo() override { travel_.stop(); }
  void drop(const std::vector<std::string>& files) override;

  /// True if the key is about how points are drawn, or about the list of classes.
  bool restyle(KeyAction action);
  void toggleList();
  void inspect(bool measure, const glm::ivec2& pixel);
  /// Text over the upper left corner, in the place of what was there.
  void layOver(const std::string& text);
  Redraw::Pause redraw();
  /// Opens the stores that the files stand for at this moment, drawn like that.
  Result<void> openStores(const DrawingOptions& drawing);
  /// Looks at files that grow; true if a frame is due.
  bool follow();
  void takePicture();
  void saveCamera();
  /// Says at the lower edge and on stdout what became of a file.
  void tell(const Result<void>& written, const std::string& file);
  void complain(const std::string& what);

  const ViewRequest request_;
  ShownFiles files_{ request_.keep, request_.signalled };
  XConnection connection_; // outlives the window
  vtkNew<vtkRenderWindow> window_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindowInteractor> interactor_;
  vtkNew<HandStyle> style_;
  MappedStores stores_;
  ViewCamera camera_{ renderer_, stores_ };
  Travel travel_{ window_, camera_ };
  Camera saved_;
  Appearance appearance_{ renderer_, stores_ };
  bool listed_ = false; ///< the classes lie over the picture
  Inspection inspection_{ renderer_, stores_ };
  TextPanel sheet_{ renderer_, TextPanel::Corner::UpperLeft };
  TextPanel notice_{ renderer_, TextPanel::Corner::LowerLeft };
  Redraw redraw_{ interactor_, [this] { return redraw(); } };
  FrameFacts facts_{ window_, renderer_, stores_, [this] { redraw_.wake(loadingPause); } };
  std::string complaint_; ///< the last one
};

Result<void> ViewWindow::open()
{
  const DrawingOptions& drawing = request_.drawing;
  if (Result<void> named = files_.name(drawing.stores); !named)
  {
    return named;
  }
  if (Result<void> opened = openStores(drawing); !opened)
  {
    return opened;
  }
  if (Result<void> connected = connection_.open(
        "a window", "use render, or python3 -m pointfront serve, which draws for a browser");
      !connected)
  {
    return connected;
  }
  forgiveLostWindows();
  renderer_->SetBackground(drawing.background.data());
  window_->SetMultiSamples(0);
  window_->SetSize(drawing.size[0], drawing.size[1]);
  window_->SetWindowName("PointFront");
  window_->AddRenderer(renderer_);
  stores_.errors().observe(window_);
  interactor_->SetRenderWindow(window_);
  interactor_->SetInteractorStyle(style_);
  style_->connect(&camera_, this);
  if (request_.camera)
  {
    camera_.set(*request_.camera);
  }
  else
  {
    camera_.showAll(request_.direction);
  }
  saved_ = camera_.camera();
  notice_.set(files_.building() ? "a first look: a store is being built" : "? for help");
  interactor_->Initialize();
  window_->Render();
  tellHeldKeys(window_->GetGenericDisplayId());
  window_->SetWindowName(("PointFront: " + drawing.stores.front()).c_str()); // it obeys from now on
  const Result<void> drawn = stores_.errors().take();
  if (!drawn && stores_.lacksPoints()) // by chance it is known that soon
  {
    complain(drawn.error().what);
    window_->Render();
    return {};
  }
  return drawn;
}

Result<void> ViewWindow::openStores(const DrawingOptions& drawing)
{
  DrawingOptions named = drawing;
  named.stores = files_.stores();
  if (Result<void> opened = appearance_.open(named); !opened)
  {
    return opened;
  }
  for (const std::string& warning : stores_.warnings())
  {
    std::fprintf(stderr, "pointfront view: warning: %s\n", printableText(warning).c_str());
  }
  return {};
}

void ViewWindow::drop(const std::vector<std::string>& files)
{
  notice_.set("");
  layOver("");
  inspection_.clear();
  Result<void> opened = files_.name(files);
  if (opened && !(opened = openStores(appearance_.drawing())))
  {
    DrawingOptions plain = request_.drawing; // an attribute of one store may be missing in another
    plain.style = StyleSheet();
    plain.classes.clear();
    plain.colourBy.clear();
    opened = openStores(plain);
  }
  if (opened)
  {
    camera_.showAll(request_.direction);
    saved_ = camera_.camera();
    window_->SetWindowName(("PointFront: " + files.front()).c_str());
    notice_.set(files_.building() ? "a first look: a store is being built" : "");
  }
  else
  {
    complain(opened.error().what);
  }
  interactor_->Render();
}

bool ViewWindow::follow()
{
  const Result<std::optional<std::string>> news = files_.look();
  if (!news)
  {
    complain(news.error().what);
    return true;
  }
  const bool other = *news && !(*news)->empty();
  if (other)
  {
    if (const Result<void> opened = openStores(appearance_.drawing()); opened)
    {
      notice_.set(**news);
    }
    else
    {
      complain(opened.error().what);
    }
  }
  if (!other && !stores_.follow())
  {
    return false;
  }
  camera_.follow();
  return true;
}

Redraw::Pause ViewWindow::redraw()
{
  if ((files_.holdsFiles() && request_.signalled()) || std::ferror(stdout) != 0)
  {
    interactor_->TerminateApp();
    return {};
  }
  if (const Result<void> heard = stores_.errors().take(); !heard)
  {
    complain(heard.error().what);
  }
  if (follow() || travel_.advance() || stores_.needsRender())
  {
    interactor_->Render();
    return loadingPause;
  }
  if (travel_.underway() || stores_.loading() != nullptr)
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
  return files_.holdsFiles() || stores_.growing() ? Redraw::Pause(watchingPause) : Redraw::Pause();
}

void ViewWindow::step()
{
  travel_.step();
  interactor_->Render();
}

bool ViewWindow::hold(const char* keysym, bool down)
{
  const bool mine = travel_.hold(keysym, down);
  redraw_.wake();
  return mine;
}

bool ViewWindow::restyle(KeyAction action)
{
  const Result<std::optional<std::string>> list =
    listed_ ? appearance_.obeyInList(action) : std::optional<std::string>();
  if (list && *list)
  {
    sheet_.set(**list);
    return true;
  }
  const Result<std::optional<std::string>> changed = list ? appearance_.obey(action) : list;
  if (!changed)
  {
    complain(changed.error().what);
    return true;
  }
  if (*changed)
  {
    notice_.set(**changed);
  }
  return changed->has_value();
}

void ViewWindow::toggleList()
{
  const Result<std::string> list =
    listed_ ? Result<std::string>(std::string()) : appearance_.listClasses();
  if (!list)
  {
    complain(list.error().what);
    return;
  }
  const bool listed = !listed_;
  layOver(*list);
  listed_ = listed;
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
      facts_.hide();
      inspection_.clear();
      break;
    case KeyAction::Classes:
      toggleList();
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
    case KeyAction::RestoreCamera:
      camera_.set(saved_);
      break;
    default:
      if (!restyle(action))
      {
        camera_.obey(action, request_.direction);
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
    if (std::ferror(stdout) != 0)
    {
      outcome = makeError(
        Error::Kind::Unwritable, "the standard output is closed, and the window ended with it");
    }
  }
  if (request.signalled()) // which may have made something fail, too
  {
    outcome = makeError(Error::Kind::Cancelled, "ended by a signal");
  }
}

} // namespace pointfront
