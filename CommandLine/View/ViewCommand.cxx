#include "ViewCommand.h"

#include "CancelSignal.h"
#include "KeyTable.h"
#include "KnownWords.h"
#include "ModuleSymbol.h"
#include "StoreCompany.h"
#include "ViewWindow.h"

#include <csignal>
#include <optional>

namespace pointfront
{

void ViewCommand::declare(CLI::App& program)
{
  app_ = program.add_subcommand("view", "Show stores or point files in a window");
  request_.drawing.declare(*app_);
  CLI::Option* const view =
    app_->add_option("--view", view_, "Where from at first, showing all (iso)")
      ->check(knownWords({ "iso", "top", "front", "back", "left", "right" }));
  app_->add_option("--camera", cameraPath_, "Camera file to begin with")
    ->type_name("FILE.json")
    ->excludes(view);
  app_
    ->add_option(
      "--store", request_.keep, "Where the store of point files is built (it goes with the window)")
    ->type_name("OUT.pfront");
  app_->footer("Mouse and keys in the window:\n" + keyHelp());
}

Result<void> ViewCommand::run()
{
  const CancelSignal leaving(CancelSignal::Mode::Leave);
  std::optional<CancelSignal> finishing;
  request_.signalled = [&finishing]
  {
    if (!finishing)
    {
      finishing.emplace(CancelSignal::Mode::Finish);
    }
    return CancelSignal::requested();
  };
  std::signal(SIGPIPE, SIG_IGN); // a closed stdout ends the window, which then removes its store
  request_.direction = *namedView(view_);
  if (!cameraPath_.empty())
  {
    const Result<Camera> camera = readCameraFile(cameraPath_);
    if (!camera)
    {
      return camera.error();
    }
    request_.camera = *camera;
  }
  for (const std::string& doubt : doubtsOfCompany(request_.drawing.stores))
  {
    warn(name(), doubt);
  }
  const Result<void*> symbol = moduleSymbol(POINTFRONT_WINDOW_MODULE, "pointfrontShowWindow",
    "a window needs a library that is not here (a build without VTK has none); use render, or "
    "python3 -m pointfront serve");
  if (!symbol)
  {
    return symbol.error();
  }
  Result<void> outcome;
  reinterpret_cast<decltype(&pointfrontShowWindow)> (*symbol)(request_, outcome);
  return outcome;
}

} // namespace pointfront
